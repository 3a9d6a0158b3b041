#include <algorithm>
#include <charconv>

#include "server/scene/errors.h"
#include "server/scene/scene.h"

namespace posed {

Result<SceneBinding> Scene::make_binding(Binding binding, const std::map<std::string, SceneGoal>& goals) const {
  if (!goals.contains(binding.goal)) return unknown("goal", binding.goal, keys(goals), "/to/goal");
  if (!(std::abs(binding.scale) <= 1000.0))
    return Error{"out_of_range", "the scale is out of range", "/scale", "-1000 to 1000"};
  SceneBinding made;
  const std::size_t colon = binding.sensor.rfind(':');
  const char* const end = binding.sensor.data() + binding.sensor.size();
  bool good = colon != std::string::npos && valid_id(binding.sensor.substr(0, colon));
  if (good) {
    const auto parsed = std::from_chars(binding.sensor.data() + colon + 1, end, made.station);
    good = parsed.ec == std::errc{} && parsed.ptr == end && made.station >= 1 && made.station <= 256;
  }
  if (!good)
    return Error{"unknown_sensor", "a sensor is named DEVICE:STATION", "/sensor",
                 "as in simulated:1; tracker.list names them"};
  made.device = binding.sensor.substr(0, colon);
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
    if (!edit.goal) return Error{"missing_field", "the new binding moves nothing", "/to", R"("to":{"goal":"g1"})"};
  }
  if (const auto error = stale(bindings_, id, if_revision)) return *error;
  binding.id = id;
  if (edit.sensor) binding.sensor = *edit.sensor;
  if (edit.goal) binding.goal = *edit.goal;
  edit.axes.apply(binding.axes);
  edit.mode.apply(binding.mode);
  edit.scale.apply(binding.scale, 1.0);
  edit.label.apply(binding.label);
  edit.user.apply(binding.user);

  Result<SceneBinding> made = make_binding(std::move(binding), goals_);
  if (!made) return made.error();
  const std::string& goal = made->binding.goal;
  for (const auto& [other_id, other] : bindings_) {
    if (other_id != id && other.binding.goal == goal) {
      return Error{"invalid_params", "goal " + goal + " is already moved by binding " + other_id, "/to/goal",
                   "remove that binding first"};
    }
  }
  if (before != bindings_.end()) {
    made->revision = before->second.revision + 1;
    if (before->second.binding.goal != goal) goals_.at(before->second.binding.goal).live.reset();
  }
  const Revision revision = made->revision;
  bindings_.insert_or_assign(id, std::move(*made));
  return Edited{id, ++revision_, revision};
}

Result<Edited> Scene::remove_binding(const std::string& id, IfRevision if_revision) {
  const auto found = bindings_.find(id);
  if (found == bindings_.end()) return unknown("binding", id, keys(bindings_), "/id");
  if (const auto error = stale(bindings_, id, if_revision)) return *error;
  // The goal stays where the sensor left it: letting go of a thing does not throw it back.
  SceneGoal& goal = goals_.at(found->second.binding.goal);
  if (goal.live) goal.goal.position = *goal.live;
  goal.live.reset();
  bindings_.erase(found);
  return Edited{id, ++revision_, 0};
}

}  // namespace posed
