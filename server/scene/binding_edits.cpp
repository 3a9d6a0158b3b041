#include <algorithm>

#include "server/scene/errors.h"
#include "server/scene/scene.h"

namespace posed {

Status Scene::check_bindable(const SceneGoal& goal, const Axes& axes) {
  if (!position_of(goal.goal.payload)) {
    return Error{"invalid_params",
                 "goal " + goal.goal.id + " is of kind " + name_of(kind_of(goal.goal.payload)) +
                     ": it has no position that a sensor could move",
                 "/to/goal", "bind a position or pose goal; another goal may be relative_to the sensor"};
  }
  if (goal.goal.relative_to.kind != GoalBase::Kind::world) {
    return Error{"not_available", "goal " + goal.goal.id + " is not relative to the world: no sensor moves it yet",
                 "/to/goal", "\"relative_to\":\"world\""};
  }
  if (axes.rotation)
    return Error{"not_available", "a sensor moves a goal's position and turns nothing yet", "/axes",
                 "name some of x y z"};
  return Ok{};
}

Status Scene::check_target(const BindingTarget& to, const Axes& axes) const {
  if (!to.object.empty()) {
    if (!objects_.contains(to.object)) return unknown("object", to.object, keys(objects_), "/to/object");
    return Ok{};
  }
  const auto goal = goals_.find(to.goal);
  if (goal == goals_.end()) return unknown("goal", to.goal, keys(goals_), "/to/goal");
  return check_bindable(goal->second, axes);
}

Result<SceneBinding> Scene::make_binding(Binding binding) const {
  const bool object = !binding.to.object.empty();
  for (const auto& [id, other] : bindings_) {
    if (id != binding.id && other.binding.to == binding.to) {
      return Error{
          "invalid_params",
          (object ? "object " + binding.to.object : "goal " + binding.to.goal) + " is already moved by binding " + id,
          object ? "/to/object" : "/to/goal", "remove that binding first"};
    }
  }
  if (!(std::abs(binding.scale) <= 1000.0))
    return Error{"out_of_range", "the scale is out of range", "/scale", "-1000 to 1000"};
  const Result<SensorName> sensor = read_sensor(binding.sensor);
  if (!sensor) return sensor.error();
  if (const Status fits = check_target(binding.to, binding.axes); !fits) return fits.error();
  SceneBinding made;
  made.sensor = *sensor;
  made.binding = std::move(binding);
  made.revision = 1;
  return made;
}

Result<Edited> Scene::set_binding(const BindingEdit& edit, IfRevision if_revision) {
  std::string id = edit.id;
  if (id.empty()) {
    if (!edit.sensor)
      return Error{"missing_field", "the binding has neither an id nor a sensor", "/sensor",
                   "\"sensor\":\"simulated:1\""};
    // First, so that a mistyped sensor is told as such and not as a bad id.
    if (const auto sensor = read_sensor(*edit.sensor); !sensor) return sensor.error();
    id = *edit.sensor;
    std::replace(id.begin(), id.end(), ':', '.');
  }
  if (const Status checked = check_id(id); !checked) return checked.error();
  const auto before = bindings_.find(id);
  Binding binding;
  if (before != bindings_.end()) {
    binding = before->second.binding;
  } else {
    if (!edit.sensor)
      return Error{"missing_field", "the new binding has no sensor", "/sensor", "\"sensor\":\"simulated:1\""};
    if (!edit.to) return Error{"missing_field", "the new binding moves nothing", "/to", R"("to":{"goal":"g1"})"};
  }
  if (const auto error = stale(bindings_, id, if_revision)) return *error;
  binding.id = id;
  if (edit.sensor) binding.sensor = *edit.sensor;
  // What moves position alone says so; another target begins with all that it can follow.
  if (edit.to && (edit.to->object.empty() != binding.to.object.empty() || before == bindings_.end()))
    binding.axes = default_axes(*edit.to);
  if (edit.to) binding.to = *edit.to;
  edit.axes.apply(binding.axes, default_axes(binding.to));
  edit.mode.apply(binding.mode);
  edit.scale.apply(binding.scale, 1.0);
  edit.label.apply(binding.label);
  edit.user.apply(binding.user);

  Result<SceneBinding> made = make_binding(std::move(binding));
  if (!made) return made.error();
  made->revision = next_revision(&Change::bindings, bindings_, id);
  if (before != bindings_.end() && before->second.binding.to != made->binding.to) let_go(before->second.binding.to);
  const Revision revision = made->revision;
  keep_binding(id);
  bindings_.insert_or_assign(id, std::move(*made));
  return Edited{id, count(), revision};
}

Result<Edited> Scene::remove_binding(const std::string& id, IfRevision if_revision) {
  const auto found = bindings_.find(id);
  if (found == bindings_.end()) return unknown("binding", id, keys(bindings_), "/id");
  if (const auto error = stale(bindings_, id, if_revision)) return *error;
  let_go(found->second.binding.to);
  keep_binding(id);
  bindings_.erase(found);
  return Edited{id, count(), 0};
}

}  // namespace posed
