// The shared document: figures with their joint values, goals, objects, cameras, bindings. Every edit is checked whole
// before anything changes, counts up the scene's revision and the entity's own, and says both. One thread (the station
// loop); no I/O.
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
#include "server/scene/change.h"
#include "server/scene/entities.h"

namespace posed {

using IfRevision = std::optional<Revision>;

struct Edited {
  std::string id;
  Revision revision = 0;         // the scene's
  Revision entity_revision = 0;  // 0: removed
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
  const std::map<std::string, SceneCamera>& cameras() const { return cameras_; }

  SceneDocument document() const;
  // What sensors move is where they have it, and nothing is bound.
  SceneDocument as_it_stands() const;
  // Replaces everything, or nothing where the document is wrong.
  Status load(const SceneDocument& document);

  // The figure that an empty id means: the only one, else "body".
  Result<const SceneFigure*> find_figure(const std::string& id) const;

  // The figure that was there hands on its pose, goals and pins; the entry's own pins are used for a new figure only.
  Result<Edited> set_figure(FigureEntry entry, IfRevision if_revision);
  Result<Edited> set_goal(const GoalEdit& edit, IfRevision if_revision);
  Result<Edited> set_object(const ObjectEdit& edit, IfRevision if_revision);
  Result<Edited> set_binding(const BindingEdit& edit, IfRevision if_revision);
  Result<Edited> set_camera(const CameraEdit& edit, IfRevision if_revision);
  // And goals of it or relative to it, and what is bound to its joints; refused while cameras are ("in_use").
  Result<Edited> remove_figure(const std::string& id, IfRevision if_revision);
  Result<Edited> remove_goal(const std::string& id, IfRevision if_revision);  // and what is bound to it
  // Refused while goals or cameras are relative to it ("in_use"); what is bound to it goes with it.
  Result<Edited> remove_object(const std::string& id, IfRevision if_revision);
  Result<Edited> remove_binding(const std::string& id, IfRevision if_revision);
  Result<Edited> remove_camera(const std::string& id, IfRevision if_revision);  // and what is bound to it
  int clear_goals(const std::string& figure);  // of all figures where empty; counts one revision
  // A pose set by hand. q is checked.
  Result<Edited> set_q(const std::string& figure, std::vector<double> q, IfRevision if_revision);

  // Holds the segment where it is now, or lets it go.
  Result<Edited> pin(const std::string& figure, const std::string& segment, std::optional<Pin::Hold> hold,
                     IfRevision if_revision);

  // Exactly these pins; where one leaves its place out, the segment is held where it is.
  Result<Edited> set_pins(const std::string& figure, std::map<std::string, Pin> pins, IfRevision if_revision);

  // After a load, as a restart finds it: `revisions` by paths ("/goals/g1").
  void resume(Revision revision, const std::map<std::string, Revision>& revisions);

  // ---- several edits as one ----

  // Edits between `begin` and `commit` count as one: the scene's revision grows by one. `commit` says what they have
  // changed, or nothing; `rollback` leaves the scene as it was.
  void begin();
  Change commit();
  void rollback();
  // What has been changed since `begin`: what stood there before.
  const Change& kept() const { return open_->before; }
  // Takes a change back: what it says and what stands there change places. One edit. Nothing changes on a conflict.
  std::optional<Conflict> revert(Change& change);
  // Whether the document has something of this path: "/goals/g1".
  bool has(const std::string& path) const;

  // A sensor's motion: moves what is bound to it or relative to it. No edit, no revision. Does not allocate, but where
  // a button asks for something.
  struct Followed {
    bool pose = false;                // something that figures are pulled by has moved
    bool cameras = false;             // cameras have
    std::vector<std::string> saving;  // bindings whose button asks for the scene to be saved
    explicit operator bool() const { return pose || cameras; }
  };
  Followed follow(const Frame& frame);
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
  Result<SceneCamera> make_camera(Camera camera) const;
  static Status check_bindable(const SceneGoal& goal, const Axes& axes);
  Result<Axes> axes_of(const BindingTarget& to) const;
  Status find_target(SceneBinding& binding) const;
  Result<std::map<std::string, SceneBinding>> refit_bindings(const std::string& figure, const SceneFigure& next) const;
  Result<std::map<std::string, SceneCamera>> refit_cameras(const std::string& figure, const SceneFigure& next) const;
  void let_go(const SceneBinding& binding);
  void follow(SceneBinding& binding, const Sample& sample, Nanoseconds t_ns, Followed& followed);
  void press(SceneBinding& binding, ButtonAction::Do act, const Transform& world_from_sensor, Followed& followed);
  void place_target(SceneBinding& binding, const Transform& wanted, Followed& followed);
  Transform home_of(const SceneBinding& binding) const;
  Transform target_of(const SceneBinding& binding) const;
  Followed carry(const SceneObject& object);
  void drop_goal(const std::string& id);
  template <class Hits>
  void drop_bindings(Hits hits) {  // where hits(target)
    for (auto it = bindings_.begin(); it != bindings_.end();) {
      const auto current = it++;
      if (!hits(current->second.binding.to)) continue;
      keep_binding(current->first);
      bindings_.erase(current);
    }
  }
  template <class Entity>
  void replace(std::map<std::string, Entity>& entities, std::map<std::string, Entity> next,
               std::map<std::string, ChangedEntity<Entity>> Change::*part);
  void take_over(Scene next);

  struct Open {
    Revision revision;  // before
    Change before;      // `other`: what stood there
  };
  Revision count();
  // The scene's after the next edit. What comes under an id begins there, so that no revision ever comes twice under
  // it.
  Revision coming() const { return (open_ ? open_->revision : revision_) + 1; }
  // The entity's own after the next edit of it. One edit grows it by one, however often it comes to the entity, so that
  // it is never above the scene's; also where it removes the entity and makes it anew.
  template <class Entity>
  Revision next_revision(std::map<std::string, ChangedEntity<Entity>> Change::*part,
                         const std::map<std::string, Entity>& entities, const std::string& id) const {
    const auto found = entities.find(id);
    const bool here = found != entities.end();
    if (open_) {
      const auto& touched = open_->before.*part;
      if (const auto kept = touched.find(id); kept != touched.end()) {
        if (kept->second.other) return std::max(here ? found->second.revision : 0, kept->second.other->revision + 1);
        return here ? found->second.revision : coming();
      }
    }
    return here ? found->second.revision + 1 : coming();
  }
  Revision next_figure_revision(const std::string& id) const;  // poses set by hand count, too
  template <class Entity>
  void keep(std::map<std::string, ChangedEntity<Entity>> Change::*part, const std::map<std::string, Entity>& entities,
            const std::string& id);
  void keep_figure(const std::string& id);
  void keep_object(const std::string& id) { keep(&Change::objects, objects_, id); }
  void keep_goal(const std::string& id) { keep(&Change::goals, goals_, id); }
  void keep_binding(const std::string& id) { keep(&Change::bindings, bindings_, id); }
  void keep_camera(const std::string& id) { keep(&Change::cameras, cameras_, id); }
  void keep_pose(const std::string& figure);
  std::optional<Conflict> changed_since(const Change& change) const;
  std::optional<Conflict> refit(const Change& change);
  void exchange(Change& change);

  std::optional<Open> open_;
  Revision revision_ = 0;
  std::map<std::string, SceneFigure> figures_;
  std::map<std::string, SceneGoal> goals_;
  std::map<std::string, SceneObject> objects_;
  std::map<std::string, SceneBinding> bindings_;
  std::map<std::string, SceneCamera> cameras_;
};

}  // namespace posed
