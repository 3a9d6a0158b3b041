// The shared scene as a plain document ("posed.scene/1"): maps keyed by id.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/binding.h"
#include "common/camera.h"
#include "common/figure.h"
#include "common/goal.h"
#include "common/object.h"

namespace posed {

// Holds a segment where it is, before all goals. In the world: the touch point (m) and the segment's orientation, each
// where the pin holds it; left out in a document that is loaded: as the figure then stands.
struct Pin {
  enum class Hold { position, orientation, pose } hold = Hold::pose;
  std::optional<Vec3> position;
  std::optional<Quat> rotation;  // world_from_segment
};

// A figure in a scene: a built-in template with its stature, or a document of its own; and its joint values.
struct FigureEntry {
  std::string id;
  std::string template_name;  // empty: `document` holds the figure
  double stature = 1.75;      // m, of the template
  std::optional<FigureDocument> document;
  std::vector<double> q;            // empty: the template's start pose
  std::map<std::string, Pin> pins;  // by segment
  std::string label;
  std::string user;
};

struct SceneDocument {
  std::map<std::string, FigureEntry> figures;
  std::map<std::string, Goal> goals;
  std::map<std::string, Object> objects;
  std::map<std::string, Binding> bindings;
  std::map<std::string, Camera> cameras;
};

}  // namespace posed
