#include "server/scene/errors.h"
#include "server/scene/scene.h"
#include "server/solver/figure_check.h"

namespace posed {
namespace {

constexpr double kMaxCoordinate = 1e6;  // m
constexpr double kMaxWeight = 1e9;

}  // namespace

Result<SceneGoal> Scene::make_goal(Goal goal, const std::map<std::string, SceneFigure>& figures) const {
  const auto figure = figures.find(goal.figure);
  if (figure == figures.end()) return unknown("figure", goal.figure, keys(figures), "/figure");
  const Result<AttachedPoint> at = figure->second.tree->attach(goal.at);
  if (!at) return below("/at", at.error());
  for (int i = 0; i < 3; ++i) {
    if (goal.at.point && !(std::abs((*goal.at.point)[i]) <= kMaxLength)) {
      return Error{"out_of_range", "the point is too far from its segment", "/at/point/" + std::to_string(i),
                   "within 10000 m, in the segment's frame"};
    }
    if (!(std::abs(goal.position[i]) <= kMaxCoordinate)) {
      return Error{"out_of_range", "the position is too far away", "/position/" + std::to_string(i),
                   "within 1000 km of the origin"};
    }
  }
  if (!(goal.weight >= 0.0 && goal.weight <= kMaxWeight)) {
    return Error{"out_of_range", "the weight is out of range", "/weight", "0 (off) to 1e9; the default is 10"};
  }
  if (!(goal.tolerance >= 0.0 && goal.tolerance <= kMaxCoordinate)) {
    return Error{"out_of_range", "the tolerance is out of range", "/tolerance", "0 or more, in metres"};
  }
  SceneGoal made;
  made.goal = std::move(goal);
  made.at = *at;
  made.revision = 1;
  return made;
}

Result<Edited> Scene::set_goal(const GoalEdit& edit, IfRevision if_revision) {
  Goal goal;
  std::string id = edit.id;
  if (id.empty() && !edit.at)
    return Error{"missing_field", "the goal has neither an id nor a place", "/at", "\"at\":\"right_hand\""};
  if (id.empty()) {
    const Result<const SceneFigure*> figure = find_figure(edit.figure);
    if (!figure) return figure.error();
    // The same place by whatever name (an alias, a site) is the same goal only where it is spelled the same.
    id =
        (*figure)->entry.id + "." + edit.at->segment + (edit.at->site.empty() ? "" : "." + edit.at->site) + ".position";
  }
  const auto before = goals_.find(id);
  if (before == goals_.end()) {
    if (!edit.at) return Error{"missing_field", "the new goal " + id + " has no place", "/at", "\"at\":\"right_hand\""};
    const Result<const SceneFigure*> figure = find_figure(edit.figure);
    if (!figure) return figure.error();
    // First, so that a mistyped segment is told as such and not as a bad id.
    if (const auto at = (*figure)->tree->attach(*edit.at); !at) return below("/at", at.error());
    if (const Status checked = check_id(id); !checked) return checked.error();
    if (!edit.position)
      return Error{"missing_field", "the new goal " + id + " has no position", "/position",
                   "\"position\":[x,y,z] in metres"};
    goal.id = id;
    goal.figure = (*figure)->entry.id;
  } else {
    goal = before->second.goal;
    if (!edit.figure.empty()) goal.figure = edit.figure;
  }
  if (const auto error = stale(goals_, id, if_revision)) return *error;
  if (edit.at) goal.at = *edit.at;
  if (edit.position) goal.position = *edit.position;
  edit.weight.apply(goal.weight, Goal{}.weight);
  edit.tolerance.apply(goal.tolerance);
  edit.enabled.apply(goal.enabled, true);
  edit.label.apply(goal.label);
  edit.user.apply(goal.user);

  Result<SceneGoal> made = make_goal(std::move(goal), figures_);
  if (!made) return made.error();
  if (before != goals_.end()) {
    made->revision = before->second.revision + 1;
    made->live = before->second.live;
  }
  const Revision revision = made->revision;
  goals_.insert_or_assign(id, std::move(*made));
  return Edited{id, ++revision_, revision};
}

Result<Edited> Scene::remove_goal(const std::string& id, IfRevision if_revision) {
  if (!goals_.contains(id)) return unknown("goal", id, keys(goals_), "/id");
  if (const auto error = stale(goals_, id, if_revision)) return *error;
  drop_goal(id);
  return Edited{id, ++revision_, 0};
}

}  // namespace posed
