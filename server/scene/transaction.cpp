// Several edits as one, and edits taken back.
#include <algorithm>
#include <set>
#include <utility>

#include "server/scene/scene.h"
#include "server/solver/kinematics.h"

namespace posed {
namespace {

template <class Entity>
using Changed = std::map<std::string, ChangedEntity<Entity>>;
template <class Entity>
using Entities = std::map<std::string, Entity>;

// Says of what is kept what has come of it, and forgets what is as it was.
template <class Entity>
void finish(Changed<Entity>& part, Entities<Entity>& entities, Content content, Footprint& print) {
  for (auto it = part.begin(); it != part.end();) {
    const auto present = entities.find(it->first);
    const bool here = present != entities.end();
    const std::optional<Entity>& before = it->second.other;
    if (here ? before && before->revision == present->second.revision : !before) {
      it = part.erase(it);
      continue;
    }
    if (here) present->second.content = content;
    it->second.expected = here ? content : 0;
    mark(print, before ? &*before : nullptr, here ? &present->second : nullptr);
    ++it;
  }
}

template <class Entity>
void restore(Changed<Entity>& part, Entities<Entity>& entities) {
  for (auto& [id, kept] : part) {
    if (kept.other)
      entities.insert_or_assign(id, std::move(*kept.other));
    else
      entities.erase(id);
  }
}

template <class Entity>
std::optional<Conflict> compare(const Changed<Entity>& part, const Entities<Entity>& entities, const char* what) {
  for (const auto& [id, changed] : part) {
    const auto present = entities.find(id);
    const Content content = present == entities.end() ? 0 : present->second.content;
    if (content == changed.expected) continue;
    return Conflict{what + id, content == 0};
  }
  return {};
}

// What is to stand there and what stands there change places. Revisions only grow.
template <class Entity>
void swap(Changed<Entity>& part, Entities<Entity>& entities, Revision coming) {
  for (auto& [id, changed] : part) {
    const auto present = entities.find(id);
    std::optional<Entity> gone;
    if (present != entities.end()) {
      gone = std::move(present->second);
      entities.erase(present);
    }
    if (changed.other) {
      changed.other->revision = gone ? std::max(changed.other->revision, gone->revision) + 1 : coming;
      entities.emplace(id, *changed.other);
    }
    changed.expected = changed.other ? changed.other->content : 0;
    changed.other = std::move(gone);
  }
}

// Figures that the goal, before or after, has to do with.
void concern(const SceneGoal& goal, std::set<std::string>& figures) {
  figures.insert(goal.goal.figure);
  if (goal.goal.relative_to.kind == GoalBase::Kind::segment) figures.insert(goal.goal.relative_to.figure);
}

}  // namespace

void Scene::begin() {
  open_.emplace(Open{revision_, {}});
}

Revision Scene::count() {
  if (!open_ || revision_ == open_->revision) ++revision_;
  return revision_;
}

template <class Entity>
void Scene::keep(Changed<Entity> Change::*part, const Entities<Entity>& entities, const std::string& id) {
  if (!open_) return;
  const auto [place, is_new] = (open_->before.*part).try_emplace(id);
  if (!is_new) return;
  if (const auto found = entities.find(id); found != entities.end()) place->second.other = found->second;
}
template void Scene::keep<SceneFigure>(Changed<SceneFigure> Change::*, const Entities<SceneFigure>&,
                                       const std::string&);
template void Scene::keep<SceneObject>(Changed<SceneObject> Change::*, const Entities<SceneObject>&,
                                       const std::string&);
template void Scene::keep<SceneGoal>(Changed<SceneGoal> Change::*, const Entities<SceneGoal>&, const std::string&);
template void Scene::keep<SceneBinding>(Changed<SceneBinding> Change::*, const Entities<SceneBinding>&,
                                        const std::string&);
template void Scene::keep<SceneCamera>(Changed<SceneCamera> Change::*, const Entities<SceneCamera>&,
                                       const std::string&);

void Scene::keep_figure(const std::string& id) {
  keep(&Change::figures, figures_, id);
  if (!open_) return;
  // A pose that was set before in the same edit has counted already.
  const auto kept = open_->before.figures.find(id);
  const auto pose = open_->before.poses.find(id);
  if (kept->second.other && pose != open_->before.poses.end()) kept->second.other->revision = pose->second.revision;
}

void Scene::keep_pose(const std::string& id) {
  if (!open_) return;
  const SceneFigure& figure = figures_.at(id);
  const auto [place, is_new] = open_->before.poses.try_emplace(id);
  if (!is_new) return;
  place->second = {figure.q, figure.pose, 0, true, figure.revision, figure.posed, 0};
  // A figure that is kept already has the values from before.
  if (const auto kept = open_->before.figures.find(id); kept != open_->before.figures.end() && kept->second.other) {
    const SceneFigure& before = *kept->second.other;
    place->second = {before.q, before.pose, 0, true, before.revision, before.posed, 0};
  }
}

Revision Scene::next_figure_revision(const std::string& id) const {
  const Revision next = next_revision(&Change::figures, figures_, id);
  if (!open_) return next;
  const auto pose = open_->before.poses.find(id);
  const auto kept = open_->before.figures.find(id);
  const bool came = kept != open_->before.figures.end() && !kept->second.other;
  return pose == open_->before.poses.end() || came ? next : pose->second.revision + 1;
}

Change Scene::commit() {
  Change change = std::move(open_->before);
  open_.reset();
  for (auto& [id, kept] : change.figures) {
    if (!kept.other) continue;
    if (const auto pose = change.poses.find(id); pose != change.poses.end()) kept.other->q = pose->second.q;
    // Whoever said the joint values: another form, or a figure made anew, is no word on them.
    if (const auto now = figures_.find(id); now != figures_.end()) now->second.posed = kept.other->posed;
  }
  finish(change.figures, figures_, revision_, change.print);
  finish(change.objects, objects_, revision_, change.print);
  finish(change.goals, goals_, revision_, change.print);
  finish(change.bindings, bindings_, revision_, change.print);
  finish(change.cameras, cameras_, revision_, change.print);

  std::set<std::string> concerned;
  const auto concern_goal = [&](const std::string& id) {
    if (const auto goal = goals_.find(id); goal != goals_.end()) concern(goal->second, concerned);
  };
  for (const auto& [id, pose] : change.poses) concerned.insert(id);
  for (const auto& [id, figure] : change.figures) concerned.insert(id);
  for (const auto& [id, goal] : change.goals) {
    if (goal.other) concern(*goal.other, concerned);
    concern_goal(id);
  }
  for (const auto& [id, goal] : goals_) {
    if (goal.goal.relative_to.kind == GoalBase::Kind::object && change.objects.contains(goal.goal.relative_to.object))
      concern(goal, concerned);
  }
  for (const auto& [id, binding] : change.bindings) {
    const auto concern_target = [&](const BindingTarget& to) {
      concern_goal(to.goal);
      if (!to.joint.empty()) concerned.insert(to.figure);
    };
    if (binding.other) concern_target(binding.other->binding.to);
    if (const auto now = bindings_.find(id); now != bindings_.end()) concern_target(now->second.binding.to);
  }
  for (const std::string& id : concerned) {
    const auto figure = figures_.find(id);
    if (figure == figures_.end()) {
      change.poses.erase(id);
      continue;
    }
    const auto [pose, is_new] = change.poses.try_emplace(id);
    if (is_new) {
      pose->second.q = figure->second.q;
      pose->second.other = figure->second.pose;
      if (const auto kept = change.figures.find(id); kept != change.figures.end() && kept->second.other) {
        pose->second.q = kept->second.other->q;
        pose->second.other = kept->second.other->pose;
      }
    }
    pose->second.expected = figure->second.pose = revision_;
    if (!pose->second.asked) continue;
    pose->second.expected_q = figure->second.posed = revision_;
    change.print.leans.insert("/figures/" + id);
  }
  return change;
}

void Scene::rollback() {
  Open open = std::move(*open_);
  open_.reset();
  restore(open.before.figures, figures_);
  for (const auto& [id, pose] : open.before.poses) {
    const auto figure = figures_.find(id);
    if (figure == figures_.end()) continue;
    figure->second.q = pose.q;
    figure->second.pose = pose.other;
    figure->second.posed = pose.other_q;
    figure->second.revision = std::min(figure->second.revision, pose.revision);
  }
  restore(open.before.objects, objects_);
  restore(open.before.goals, goals_);
  restore(open.before.bindings, bindings_);
  restore(open.before.cameras, cameras_);
  revision_ = open.revision;
  for (const auto& [id, object] : objects_) carry(object);
}

std::optional<Conflict> Scene::changed_since(const Change& change) const {
  if (auto c = compare(change.figures, figures_, "/figures/")) return c;
  if (auto c = compare(change.objects, objects_, "/objects/")) return c;
  if (auto c = compare(change.goals, goals_, "/goals/")) return c;
  if (auto c = compare(change.bindings, bindings_, "/bindings/")) return c;
  if (auto c = compare(change.cameras, cameras_, "/cameras/")) return c;
  for (const auto& [id, pose] : change.poses) {
    const auto figure = figures_.find(id);
    if (!pose.asked || (figure != figures_.end() && figure->second.posed == pose.expected_q)) continue;
    if (figure == figures_.end() && change.figures.contains(id)) continue;  // it brings its pose along
    return Conflict{"/figures/" + id + "/q", figure == figures_.end()};
  }
  return {};
}

bool Scene::has(const std::string& path) const {
  const std::size_t slash = path.find('/', 1);
  const std::string kind = path.substr(0, slash + 1);
  std::string id = path.substr(slash + 1);
  id = id.substr(0, id.find('/'));
  return kind == "/figures/"   ? figures_.contains(id)
         : kind == "/objects/" ? objects_.contains(id)
         : kind == "/goals/"   ? goals_.contains(id)
         : kind == "/cameras/" ? cameras_.contains(id)
                               : bindings_.contains(id);
}

void Scene::exchange(Change& change) {
  struct Posed {
    std::vector<double> q;
    Content pose, posed;
  };
  std::map<std::string, Posed> present;
  for (const auto& [id, pose] : change.poses) {
    if (const auto figure = figures_.find(id); figure != figures_.end())
      present[id] = {figure->second.q, figure->second.pose, figure->second.posed};
  }
  swap(change.figures, figures_, coming());
  swap(change.objects, objects_, coming());
  swap(change.goals, goals_, coming());
  swap(change.bindings, bindings_, coming());
  swap(change.cameras, cameras_, coming());
  for (auto& [id, pose] : change.poses) {
    const auto now = figures_.find(id);
    const auto was = present.find(id);
    if (now == figures_.end() || was == present.end()) continue;  // it takes its pose along
    SceneFigure& figure = now->second;
    // Where nobody else has had to do with the figure its pose comes back, too; else it stays.
    const bool alone = was->second.pose == pose.expected;
    if ((alone || pose.asked) && check_q(*figure.tree, pose.q))
      figure.q = std::exchange(pose.q, was->second.q);
    else if (check_q(*figure.tree, was->second.q))
      figure.q = was->second.q;
    figure.pose = alone ? pose.other : revision_ + 1;
    pose.other = std::exchange(pose.expected, alone ? figure.pose : 0);
    figure.posed = was->second.posed;
    if (!pose.asked) continue;
    figure.posed = pose.other_q;
    std::swap(pose.other_q, pose.expected_q);
    if (!change.figures.contains(id)) ++figure.revision;
  }
}

// Names find their places anew: what one edit brought back, another may have taken away.
std::optional<Conflict> Scene::refit(const Change& change) {
  const auto gone = [](const char* what, const std::string& id) {
    return Conflict{std::string("/") + what + "s/" + id, true};
  };
  std::set<std::string> bound;  // paths of goals, objects and cameras
  for (const auto& [id, binding] : bindings_) {
    const BindingTarget& to = binding.binding.to;
    bound.insert(!to.goal.empty()     ? "/goals/" + to.goal
                 : !to.object.empty() ? "/objects/" + to.object
                                      : "/cameras/" + to.camera);
  }
  for (auto& [id, goal] : goals_) {
    if (!bound.contains("/goals/" + id)) goal.live.reset();
    const GoalBase& base = goal.goal.relative_to;
    if (!figures_.contains(goal.goal.figure) ||
        (base.kind == GoalBase::Kind::segment && !figures_.contains(base.figure)) ||
        (base.kind == GoalBase::Kind::object && !objects_.contains(base.object))) {
      const bool figure_gone = !figures_.contains(goal.goal.figure);
      if (!change.goals.contains(id)) return Conflict{"/goals/" + id, false};
      if (!figure_gone && base.kind == GoalBase::Kind::object) return gone("object", base.object);
      return gone("figure", figure_gone ? goal.goal.figure : base.figure);
    }
    if (!change.goals.contains(id) && !change.figures.contains(goal.goal.figure) &&
        !change.figures.contains(base.figure))
      continue;
    Result<SceneGoal> again = make_goal(goal.goal, figures_);
    if (!again) {
      if (!change.goals.contains(id)) return Conflict{"/goals/" + id, false};
      return Conflict{"/figures/" + goal.goal.figure, false};
    }
    static_cast<EntityState&>(*again) = goal;
    again->live = goal.live;
    if (base.kind == GoalBase::Kind::sensor) {
      again->world_from_base = goal.world_from_base;
      again->base_moves = goal.base_moves;
    }
    goal = std::move(*again);
  }
  for (auto& [id, object] : objects_) {
    if (!bound.contains("/objects/" + id)) object.live.reset();
    carry(object);
  }
  for (auto& [id, camera] : cameras_) {
    if (!bound.contains("/cameras/" + id)) camera.live.reset();
    const GoalBase& base = camera.camera.relative_to;
    const Result<SceneCamera> again = make_camera(camera.camera);
    if (again) {
      camera.base_segment = again->base_segment;
      if (base.kind == GoalBase::Kind::object) camera.world_from_base = again->world_from_base;
      continue;
    }
    if (!change.cameras.contains(id)) return Conflict{"/cameras/" + id, false};
    return base.kind == GoalBase::Kind::object ? gone("object", base.object) : gone("figure", base.figure);
  }
  for (auto& [id, binding] : bindings_) {
    const BindingTarget& to = binding.binding.to;
    if (const Result<SceneBinding> again = make_binding(binding.binding)) {
      binding.joint = again->joint;
      if (change.bindings.contains(id)) {
        binding.anchor.reset();
        binding.rest.reset();
        binding.moves_joint = false;
      }
      continue;
    }
    if (!change.bindings.contains(id)) return Conflict{"/bindings/" + id, false};
    if (!to.goal.empty() && !goals_.contains(to.goal)) return gone("goal", to.goal);
    if (!to.object.empty() && !objects_.contains(to.object)) return gone("object", to.object);
    if (!to.camera.empty() && !cameras_.contains(to.camera)) return gone("camera", to.camera);
    if (!to.joint.empty()) return gone("figure", to.figure);
    for (const auto& [other_id, other] : bindings_) {
      if (other_id != id && other.binding.to == to) return Conflict{"/bindings/" + other_id, false};
    }
    if (!to.camera.empty()) return Conflict{"/cameras/" + to.camera, false};
    return Conflict{"/goals/" + to.goal, false};
  }
  return {};
}

std::optional<Conflict> Scene::revert(Change& change) {
  if (auto conflict = changed_since(change)) return conflict;
  begin();
  for (const auto& [id, changed] : change.figures) keep_figure(id);
  for (const auto& [id, changed] : change.objects) keep_object(id);
  for (const auto& [id, changed] : change.goals) keep_goal(id);
  for (const auto& [id, changed] : change.bindings) keep_binding(id);
  for (const auto& [id, changed] : change.cameras) keep_camera(id);
  for (const auto& [id, changed] : change.poses) {
    if (figures_.contains(id)) keep_pose(id);
  }
  // Goals that are fitted to a figure which changes.
  for (const auto& [id, goal] : goals_) {
    if (change.figures.contains(goal.goal.figure) || change.figures.contains(goal.goal.relative_to.figure))
      keep_goal(id);
  }
  Change taken_back = change;
  exchange(taken_back);
  if (auto conflict = refit(taken_back)) {
    rollback();
    return conflict;
  }
  change = std::move(taken_back);
  count();
  open_.reset();
  return {};
}

}  // namespace posed
