// Cameras as documents of the scene: eyes that look along their own +X, with their own +Z up. Plain values.
#pragma once

#include <string>

#include "common/goal.h"
#include "common/math.h"
#include "common/patched.h"

namespace posed {

inline constexpr double kDefaultFovY = 0.8726646259971648;  // 50 degrees

struct Camera {
  std::string id;
  GoalBase relative_to;  // a segment's figure left out: the only one, else "body"
  Transform base_from_camera;
  double fov_y = kDefaultFovY;  // rad, from the lowest to the highest ray
  std::string label;
  std::string user;
};

struct CameraEdit {
  std::string id;
  Patched<Vec3> position;
  Patched<Quat> rotation;
  Patched<GoalBase> relative_to;
  Patched<double> fov_y;
  Patched<std::string> label;
  Patched<std::string> user;
};

}  // namespace posed
