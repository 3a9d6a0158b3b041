#include "server/scene/errors.h"
#include "server/scene/scene.h"
#include "server/solver/kinematics.h"
#include "server/solver/tempus.h"

namespace posed {
namespace {

bool concerns(const Goal& goal, const std::string& figure) {
  const GoalBase& base = goal.relative_to;
  return goal.figure == figure || (base.kind == GoalBase::Kind::segment && base.figure == figure);
}

// Another stature keeps the pose: same joints, same values. Pins stay where their segments do.
void hand_on(const SceneFigure& before, SceneFigure& after) {
  if (before.q.size() == after.q.size() && check_q(*after.tree, before.q)) after.q = before.q;
  for (const auto& [name, pin] : before.entry.pins) {
    const auto segment = after.tree->find_segment(name);
    if (segment) after.entry.pins.emplace(after.tree->segment(*segment).name, pin);
  }
}

}  // namespace

Result<SceneFigure> Scene::make_figure(FigureEntry entry) const {
  FigureDocument document;
  if (entry.document) {
    if (!entry.template_name.empty()) {
      return Error{"invalid_params", "a figure is either a template or a document", "/template", "leave one out"};
    }
    document = *entry.document;
  } else if (entry.template_name == "tempus") {
    Result<FigureDocument> made = tempus(entry.stature);
    if (!made) return made.error();
    document = std::move(*made);
  } else if (entry.template_name.empty()) {
    return Error{"missing_field", "the figure has neither a template nor a document", "/template",
                 "\"template\":\"tempus\""};
  } else {
    return Error{"bad_figure", "no figure template is called " + entry.template_name.substr(0, 64), "/template",
                 "tempus is built in"};
  }
  Result<BodyTree> tree = BodyTree::build(document);
  if (!tree) return below("/document", tree.error());

  SceneFigure figure;
  figure.tree = std::make_shared<const BodyTree>(std::move(*tree));
  figure.q = entry.q;
  if (figure.q.empty()) figure.q = start_pose(*figure.tree);
  if (const Status checked = check_q(*figure.tree, figure.q); !checked) return below("/q", checked.error());
  entry.q.clear();
  figure.entry = std::move(entry);
  if (const Status pinned = complete_pins(figure); !pinned) return pinned.error();
  figure.revision = 1;
  return figure;
}

Result<Edited> Scene::set_figure(FigureEntry entry, IfRevision if_revision) {
  const std::string id = entry.id;
  if (const Status checked = check_id(id); !checked) return checked.error();
  if (const auto error = stale(figures_, id, if_revision)) return *error;
  const auto before = figures_.find(id);
  const Revision revision = next_figure_revision(id);

  if (before != figures_.end()) entry.pins.clear();
  Result<SceneFigure> figure = make_figure(std::move(entry));
  if (!figure) return figure.error();
  if (before != figures_.end()) hand_on(before->second, *figure);
  figure->revision = revision;
  std::map<std::string, SceneFigure> figures = figures_;
  figures.insert_or_assign(id, std::move(*figure));

  // Goals that have to do with it must still find their places.
  std::map<std::string, SceneGoal> goals;
  for (const auto& [goal_id, goal] : goals_) {
    if (!concerns(goal.goal, id)) continue;
    Result<SceneGoal> again = make_goal(goal.goal, figures);
    if (!again) {
      return Error{again.error().code, "goal " + goal_id + " does not fit the new figure: " + again.error().message,
                   "/id", "remove the goal first"};
    }
    static_cast<EntityState&>(*again) = goal;
    again->live = goal.live;
    again->world_from_base = goal.world_from_base;
    again->base_moves = goal.base_moves;
    goals.emplace(goal_id, std::move(*again));
  }
  Result<std::map<std::string, SceneBinding>> bindings = refit_bindings(id, figures.at(id));
  if (!bindings) return bindings.error();
  Result<std::map<std::string, SceneCamera>> cameras = refit_cameras(id, figures.at(id));
  if (!cameras) return cameras.error();
  keep_figure(id);
  for (const auto& [goal_id, goal] : goals) keep_goal(goal_id);
  for (const auto& [binding_id, binding] : *bindings) keep_binding(binding_id);
  for (const auto& [camera_id, camera] : *cameras) keep_camera(camera_id);
  for (auto& [goal_id, goal] : goals) goals_.insert_or_assign(goal_id, std::move(goal));
  for (auto& [binding_id, binding] : *bindings) bindings_.insert_or_assign(binding_id, std::move(binding));
  for (auto& [camera_id, camera] : *cameras) cameras_.insert_or_assign(camera_id, std::move(camera));
  figures_ = std::move(figures);
  return Edited{id, count(), revision};
}

Result<Edited> Scene::remove_figure(const std::string& id, IfRevision if_revision) {
  if (!figures_.contains(id)) return unknown("figure", id, keys(figures_), "/id");
  if (const auto error = stale(figures_, id, if_revision)) return *error;
  for (const auto& [camera_id, camera] : cameras_) {
    const GoalBase& base = camera.camera.relative_to;
    if (base.kind == GoalBase::Kind::segment && base.figure == id)
      return Error{"in_use", "camera " + camera_id + " is relative to figure " + id, "/id",
                   "remove it or set its relative_to first"};
  }
  std::vector<std::string> orphans;
  for (const auto& [goal_id, goal] : goals_) {
    if (concerns(goal.goal, id)) orphans.push_back(goal_id);
  }
  for (const std::string& goal_id : orphans) drop_goal(goal_id);
  drop_bindings([&](const BindingTarget& to) { return to.figure == id; });
  keep_figure(id);
  figures_.erase(id);
  return Edited{id, count(), 0};
}

Result<Edited> Scene::set_q(const std::string& id, std::vector<double> q, IfRevision if_revision) {
  const Result<const SceneFigure*> found = find_figure(id);
  if (!found) return found.error();
  SceneFigure& figure = figures_.at((*found)->entry.id);
  if (const auto error = stale(figures_, figure.entry.id, if_revision)) return *error;
  if (const Status checked = check_q(*figure.tree, q); !checked) return below("/q", checked.error());
  keep_pose(figure.entry.id);
  figure.q = std::move(q);
  figure.revision = next_figure_revision(figure.entry.id);
  return Edited{figure.entry.id, count(), figure.revision};
}

}  // namespace posed
