#include "server/scene/errors.h"
#include "server/scene/goal_resolve.h"
#include "server/scene/scene.h"

namespace posed {
namespace {

constexpr double kMaxWeight = 1e9;
constexpr int kMaxPriority = 100;

std::optional<Error> check_weight(double weight, const char* path) {
  if (weight >= 0.0 && weight <= kMaxWeight) return {};
  return Error{"out_of_range", "the weight is out of range", path, "0 (off) to 1e9; the default is 10"};
}

std::optional<Error> check_numbers(const Goal& goal) {
  const GoalWeight& weight = goal.weight;
  if (auto e = check_weight(weight.value, weight.orientation ? "/weight/position" : "/weight")) return e;
  if (weight.orientation) {
    if (kind_of(goal.payload) != GoalKind::pose)
      return Error{"invalid_params", "only a pose goal has two weights", "/weight", "\"weight\":10"};
    if (auto e = check_weight(*weight.orientation, "/weight/orientation")) return e;
  }
  if (goal.priority < -kMaxPriority || goal.priority > kMaxPriority)
    return Error{"out_of_range", "the priority is out of range", "/priority", "-100 to 100; lower is met first"};
  const GoalTolerance& tolerance = goal.tolerance;
  const Vec3 sides = tolerance.box.value_or(Vec3(tolerance.radius));
  for (int k = 0; k < 3; ++k) {
    if (!(sides[k] >= 0.0 && sides[k] <= kMaxCoordinate)) {
      return Error{"out_of_range", "the tolerance is out of range",
                   tolerance.box ? "/tolerance/" + std::to_string(k) : "/tolerance", "0 or more, in metres"};
    }
  }
  if (tolerance.box && !position_of(goal.payload))
    return Error{"invalid_params", "only a position has a box of tolerance", "/tolerance", "a radius in metres, 0.01"};
  return {};
}

}  // namespace

Result<SceneGoal> Scene::make_goal(Goal goal, const std::map<std::string, SceneFigure>& figures) const {
  const auto figure = figures.find(goal.figure);
  if (figure == figures.end()) return unknown("figure", goal.figure, keys(figures), "/figure");
  const BodyTree& tree = *figure->second.tree;
  const GoalKind kind = kind_of(goal.payload);
  SceneGoal made;
  if (takes_hold(kind)) {
    if (goal.at.empty())
      return Error{"missing_field", "goal " + goal.id + " has no place", "/at", "\"at\":\"right_hand\""};
    const Result<AttachedPoint> at = resolve_place(goal.at, tree, "/at");
    if (!at) return at.error();
    made.at = *at;
  } else if (!goal.at.empty()) {
    return Error{"invalid_params", std::string("a ") + name_of(kind) + " goal takes no hold anywhere", "/at",
                 "leave it out"};
  }
  Result<Spring> spring = resolve_payload(goal.payload, tree);
  if (!spring) return spring.error();
  made.spring = std::move(*spring);
  if (auto e = check_numbers(goal)) return *e;

  GoalBase& base = goal.relative_to;
  if (base.kind != GoalBase::Kind::world && !has_frame(kind)) {
    return Error{"invalid_params", std::string("a ") + name_of(kind) + " goal is relative to nothing", "/relative_to",
                 "leave it out"};
  }
  if (base.kind == GoalBase::Kind::segment) {
    if (base.figure.empty()) base.figure = goal.figure;
    const auto other = figures.find(base.figure);
    if (other == figures.end()) return unknown("figure", base.figure, keys(figures), "/relative_to/figure");
    const Result<AttachedPoint> place = other->second.tree->attach({base.segment, {}, ""});
    if (!place) return below("/relative_to/segment", place.error());
    made.base_segment = place->segment;
  } else if (base.kind == GoalBase::Kind::sensor) {
    const Result<SensorName> sensor = read_sensor(base.sensor);
    if (!sensor) return below("/relative_to", sensor.error());
    made.base_sensor = *sensor;
  } else if (base.kind == GoalBase::Kind::object) {
    const auto object = objects_.find(base.object);
    if (object == objects_.end()) return unknown("object", base.object, keys(objects_), "/relative_to/object");
    made.world_from_base = object->second.world_from_object();
    made.base_moves = object->second.live.has_value();
  }
  made.goal = std::move(goal);
  made.revision = 1;
  return made;
}

Result<Edited> Scene::set_goal(const GoalEdit& edit, IfRevision if_revision) {
  std::string id = edit.id;
  if (id.empty()) {
    const Result<std::string> name = default_id(edit);
    if (!name) return name.error();
    id = *name;
  }
  const auto before = goals_.find(id);
  const bool is_new = before == goals_.end();
  Goal goal;
  if (is_new) {
    const Result<const SceneFigure*> figure = find_figure(edit.figure);
    if (!figure) return figure.error();
    // First, so that a mistyped segment is told as such and not as a bad id.
    if (edit.at) {
      if (const auto at = (*figure)->tree->attach(*edit.at); !at) return below("/at", at.error());
    }
    if (const Status checked = check_id(id); !checked) return checked.error();
    goal.id = id;
    goal.figure = (*figure)->entry.id;
  } else {
    goal = before->second.goal;
    if (!edit.figure.empty()) goal.figure = edit.figure;
  }
  if (const auto error = stale(goals_, id, if_revision)) return *error;

  Result<GoalPayload> payload = payload_after(is_new ? nullptr : &goal.payload, edit);
  if (!payload) return payload.error();
  // What the new kind can not have goes with the old one.
  const GoalKind kind = kind_of(*payload);
  if (!takes_hold(kind)) goal.at = {};
  if (!has_frame(kind)) goal.relative_to = {};
  if (kind != GoalKind::pose) goal.weight.orientation.reset();
  goal.payload = std::move(*payload);
  if (edit.at) goal.at = *edit.at;
  edit.relative_to.apply(goal.relative_to);
  edit.weight.apply(goal.weight);
  edit.priority.apply(goal.priority);
  edit.tolerance.apply(goal.tolerance);
  edit.enabled.apply(goal.enabled, true);
  edit.label.apply(goal.label);
  edit.user.apply(goal.user);

  Result<SceneGoal> made = make_goal(std::move(goal), figures_);
  if (!made) return made.error();
  for (const auto& [binding_id, binding] : bindings_) {
    if (binding.binding.to.goal != id) continue;
    if (const Status fits = check_bindable(*made, *binding.binding.axes); !fits) {
      return Error{fits.error().code, "binding " + binding_id + " moves it: " + fits.error().message,
                   fits.error().code == "not_available" ? "/relative_to" : std::string("/") + name_of(kind),
                   "remove the binding first"};
    }
  }
  made->revision = next_revision(&Change::goals, goals_, id);
  if (!is_new) {
    made->live = before->second.live;
    if (made->base_sensor.station != 0 && made->base_sensor == before->second.base_sensor) {
      made->world_from_base = before->second.world_from_base;
      made->base_moves = before->second.base_moves;
    }
  }
  const Revision revision = made->revision;
  keep_goal(id);
  goals_.insert_or_assign(id, std::move(*made));
  return Edited{id, count(), revision};
}

Result<std::string> Scene::default_id(const GoalEdit& edit) const {
  const Result<const SceneFigure*> figure = find_figure(edit.figure);
  if (!figure) return figure.error();
  // Without a payload it is an edit of the goal that the place and the kind name.
  GoalKind kind = edit.kind.value_or(GoalKind::position);
  if (const auto payload = payload_after(nullptr, edit)) {
    kind = kind_of(*payload);
  } else if (payload.error().code != "missing_field") {
    return payload.error();
  }
  const std::string& name = (*figure)->entry.id;
  if (!takes_hold(kind)) return name + "." + name_of(kind);
  if (!edit.at) return Error{"missing_field", "the goal has neither an id nor a place", "/at", "\"at\":\"right_hand\""};
  // The same place by whatever name (an alias, a site) is the same goal only where it is spelled the same.
  return name + "." + edit.at->segment + (edit.at->site.empty() ? "" : "." + edit.at->site) + "." + name_of(kind);
}

Result<Edited> Scene::remove_goal(const std::string& id, IfRevision if_revision) {
  if (!goals_.contains(id)) return unknown("goal", id, keys(goals_), "/id");
  if (const auto error = stale(goals_, id, if_revision)) return *error;
  drop_goal(id);
  return Edited{id, count(), 0};
}

}  // namespace posed
