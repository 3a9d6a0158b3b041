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
#include "server/scene/sensor_name.h"
#include "server/solver/body_tree.h"
#include "server/solver/spring_goal.h"

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
  AttachedPoint at;        // of kinds that take hold
  Spring spring;           // the payload, its names resolved
  int base_segment = -1;   // relative to a segment: which, of the figure goal.relative_to.figure
  SensorName base_sensor;  // relative to a sensor
  // What sensors say; no part of the document.
  std::optional<Vec3> live;                  // where a bound sensor has the goal's position, in the world
  std::optional<Transform> world_from_base;  // relative to an object, or to a sensor that has been heard
  bool base_moves = false;                   // sensors move the base
  Revision revision = 0;

  // Of position and pose goals.
  Vec3 target() const {
    const Vec3* position = position_of(goal.payload);
    return live ? *live : position ? *position : kZero;
  }
  bool follows_sensors() const { return live || base_moves; }
};

struct SceneObject {
  Object object;                  // its rotation has unit length
  std::optional<Transform> live;  // where a bound sensor has it; no part of the document
  Revision revision = 0;

  const Transform& world_from_object() const { return live ? *live : object.world_from_object; }
};

struct SceneBinding {
  Binding binding;
  SensorName sensor;
  struct Anchor {
    Transform sensor, target;
  };
  std::optional<Anchor> anchor;  // relative mode: where both stood at the first sample
  Revision revision = 0;
};

class Scene {
 public:
  Scene() = default;
  // Of one figure, which is taken as it is.
  explicit Scene(SceneFigure figure);

  Revision revision() const { return revision_; }
  const std::map<std::string, SceneFigure>& figures() const { return figures_; }
  const std::map<std::string, SceneGoal>& goals() const { return goals_; }
  const std::map<std::string, SceneObject>& objects() const { return objects_; }
  const std::map<std::string, SceneBinding>& bindings() const { return bindings_; }

  SceneDocument document() const;
  // Replaces everything, or nothing where the document is wrong.
  Status load(const SceneDocument& document);

  // The figure that an empty id means: the only one, else "body".
  Result<const SceneFigure*> find_figure(const std::string& id) const;

  // The figure that was there hands on its pose, goals and pins; the entry's own pins are used for a new figure only.
  Result<Edited> set_figure(FigureEntry entry, IfRevision if_revision);
  Result<Edited> set_goal(const GoalEdit& edit, IfRevision if_revision);
  Result<Edited> set_object(const ObjectEdit& edit, IfRevision if_revision);
  Result<Edited> set_binding(const BindingEdit& edit, IfRevision if_revision);
  Result<Edited> remove_figure(const std::string& id, IfRevision if_revision);  // and goals of it or relative to it
  Result<Edited> remove_goal(const std::string& id, IfRevision if_revision);    // and what is bound to it
  // Refused while goals are relative to it ("in_use"); what is bound to it goes with it.
  Result<Edited> remove_object(const std::string& id, IfRevision if_revision);
  Result<Edited> remove_binding(const std::string& id, IfRevision if_revision);
  int clear_goals(const std::string& figure);  // of all figures where empty; counts one revision
  // A pose set by hand. q is checked.
  Result<Edited> set_q(const std::string& figure, std::vector<double> q, IfRevision if_revision);

  // Holds the segment where it is now, or lets it go.
  Result<Edited> pin(const std::string& figure, const std::string& segment, std::optional<Pin::Hold> hold,
                     IfRevision if_revision);

  // Exactly these pins; where one leaves its place out, the segment is held where it is.
  Result<Edited> set_pins(const std::string& figure, std::map<std::string, Pin> pins, IfRevision if_revision);

  // A sensor's motion: moves what is bound to it or relative to it. No edit, no revision. True where a target moved.
  // Does not allocate.
  bool follow(const Frame& frame);
  // The solver's answer for a figure. No edit.
  void settle(const std::string& figure, const std::vector<double>& q);

 private:
  Status check_id(const std::string& id) const;
  Result<SceneFigure> make_figure(FigureEntry entry) const;
  static Status complete_pins(SceneFigure& figure);
  Result<SceneGoal> make_goal(Goal goal, const std::map<std::string, SceneFigure>& figures) const;
  static Result<SceneObject> make_object(Object object);
  Result<SceneBinding> make_binding(Binding binding) const;
  Result<std::string> default_id(const GoalEdit& edit) const;  // FIGURE.SEGMENT.KIND
  static Status check_bindable(const SceneGoal& goal, const Axes& axes);
  Status check_target(const BindingTarget& to, const Axes& axes) const;
  void let_go(const BindingTarget& target);
  bool place_target(const BindingTarget& to, const Axes& axes, const Transform& wanted);
  Transform target_of(const BindingTarget& to) const;
  bool carry(const SceneObject& object);
  void drop_goal(const std::string& id);

  Revision revision_ = 0;
  std::map<std::string, SceneFigure> figures_;
  std::map<std::string, SceneGoal> goals_;
  std::map<std::string, SceneObject> objects_;
  std::map<std::string, SceneBinding> bindings_;
};

}  // namespace posed
