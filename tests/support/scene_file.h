// A scene document as the solver takes it, for tests and benchmarks. Reads as little of "posed.scene/1" as they need:
// one figure made from the built-in template, and position goals in the world. The product's codec is in proto/.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/solver/reach_tree_solver.h"

namespace posed::test {

struct SceneFile {
  std::shared_ptr<const BodyTree> tree;
  std::vector<double> start;     // joint values
  std::vector<std::string> ids;  // of the goals, sorted
  std::vector<ReachGoal> goals;  // in the same order

  ReachGoal& goal(const std::string& id);
  int index(const std::string& id) const;  // throws for an id that is not there
};

// Throws std::runtime_error with the reason for a file that can not be read: for tests only.
SceneFile read_scene_file(const std::string& path);
SceneFile read_scene(const std::string& text);

// The built-in template of this name, from server/scene/templates under the source folder.
SceneFile read_template(const std::string& source_dir, const std::string& name);

}  // namespace posed::test
