// The shared document: figures with their joint values, goals, bindings. Every edit is checked whole before anything
// changes, counts up the scene's revision and the entity's own, and says both. One thread (the station loop); no I/O.
//
// Errors carry paths relative to the edit ("/at"); `if_revision` is compared with the entity's own revision, 0 meaning
// that it must not exist yet ("revision_mismatch").
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/frame.h"
#include "common/goal.h"
#include "common/result.h"
#include "common/scene.h"
#include "server/solver/body_tree.h"

namespace posed {

using Revision = std::uint64_t;
using IfRevision = std::optional<Revision>;

struct Edited {
  std::string id;
  Revision revision = 0;         // the scene's
  Revision entity_revision = 0;  // 0: removed
};

struct SceneFigure {
  FigureEntry entry;  // its q is empty: the values are in `q`
  std::shared_ptr<const BodyTree> tree;
  std::vector<double> q;
  Revision revision = 0;
};

struct SceneGoal {
  Goal goal;
  AttachedPoint at;
  std::optional<Vec3> live;  // where a bound sensor has it, in the world; no part of the document
  Revision revision = 0;

  const Vec3& target() const { return live ? *live : goal.position; }
};

struct SceneBinding {
  Binding binding;
  std::string device;  // of the sensor DEVICE:STATION
  int station = 0;
  struct Anchor {
    Vec3 sensor, target;
  };
  std::optional<Anchor> anchor;  // relative mode: where both stood at the first sample
  Revision revision = 0;
};

class Scene {
 public:
  Revision revision() const { return revision_; }
  const std::map<std::string, SceneFigure>& figures() const { return figures_; }
  const std::map<std::string, SceneGoal>& goals() const { return goals_; }
  const std::map<std::string, SceneBinding>& bindings() const { return bindings_; }

  SceneDocument document() const;
  // Replaces everything, or nothing where the document is wrong.
  Status load(const SceneDocument& document);

  // The figure that an empty id means: the only one, else "body".
  Result<const SceneFigure*> find_figure(const std::string& id) const;

  Result<Edited> set_figure(FigureEntry entry, IfRevision if_revision);
  Result<Edited> set_goal(const GoalEdit& edit, IfRevision if_revision);
  Result<Edited> set_binding(const BindingEdit& edit, IfRevision if_revision);
  Result<Edited> remove_figure(const std::string& id, IfRevision if_revision);  // and its goals
  Result<Edited> remove_goal(const std::string& id, IfRevision if_revision);    // and what is bound to it
  Result<Edited> remove_binding(const std::string& id, IfRevision if_revision);
  int clear_goals(const std::string& figure);  // of all figures where empty; counts one revision
  // A pose set by hand. q is checked.
  Result<Edited> set_q(const std::string& figure, std::vector<double> q, IfRevision if_revision);

  // A sensor's motion: moves bound goals. No edit, no revision. True where a target moved. Does not allocate.
  bool follow(const Frame& frame);
  // The solver's answer for a figure. No edit.
  void settle(const std::string& figure, const std::vector<double>& q);

 private:
  Status check_id(const std::string& id) const;
  Result<SceneFigure> make_figure(FigureEntry entry) const;
  Result<SceneGoal> make_goal(Goal goal, const std::map<std::string, SceneFigure>& figures) const;
  Result<SceneBinding> make_binding(Binding binding) const;
  static void let_go(SceneGoal& goal);
  void drop_goal(const std::string& id);

  Revision revision_ = 0;
  std::map<std::string, SceneFigure> figures_;
  std::map<std::string, SceneGoal> goals_;
  std::map<std::string, SceneBinding> bindings_;
};

}  // namespace posed
