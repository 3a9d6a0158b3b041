// Objects as documents of the scene: things that goals can be relative to, a chair or a steering wheel. Plain values.
#pragma once

#include <string>
#include <vector>

#include "common/figure.h"
#include "common/math.h"
#include "common/patched.h"

namespace posed {

struct Object {
  std::string id;
  Transform world_from_object;
  std::vector<Shape> shapes;  // object's frame, metres; to look at, nothing collides
  std::string label;
  std::string user;
};

struct ObjectEdit {
  std::string id;
  Patched<Vec3> position;
  Patched<Quat> rotation;
  Patched<std::vector<Shape>> shapes;
  Patched<std::string> label;
  Patched<std::string> user;
};

}  // namespace posed
