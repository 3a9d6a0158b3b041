// The shared scene as a plain document ("posed.scene/1"): maps keyed by id.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/figure.h"
#include "common/goal.h"

namespace posed {

// A figure in a scene: a built-in template with its stature, or a document of its own; and its joint values.
struct FigureEntry {
  std::string id;
  std::string template_name;  // empty: `document` holds the figure
  double stature = 1.75;      // m, of the template
  std::optional<FigureDocument> document;
  std::vector<double> q;  // empty: the template's start pose
  std::string label;
  std::string user;
};

struct SceneDocument {
  std::map<std::string, FigureEntry> figures;
  std::map<std::string, Goal> goals;
  std::map<std::string, Binding> bindings;
};

}  // namespace posed
