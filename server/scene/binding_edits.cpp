#include <algorithm>

#include "server/scene/errors.h"
#include "server/scene/joint_value.h"
#include "server/scene/scene.h"

namespace posed {
namespace {

constexpr int kMaxButton = 31;
constexpr double kMaxOffset = 100.0;  // m
constexpr double kMaxCutoff = 1000.0, kMaxBeta = 10'000.0, kMaxPredict = 100.0;

bool within(double value, double low, double high) {
  return value >= low && value <= high;
}

std::string name(const BindingTarget& to) {
  if (!to.goal.empty()) return "goal " + to.goal;
  if (!to.object.empty()) return "object " + to.object;
  if (!to.camera.empty()) return "camera " + to.camera;
  return "joint " + to.joint + " of figure " + to.figure;
}

std::string path(const BindingTarget& to) {
  return !to.goal.empty()     ? "/to/goal"
         : !to.object.empty() ? "/to/object"
         : !to.camera.empty() ? "/to/camera"
                              : "/to/joint";
}

// A goal, an object, a camera, a joint: each follows its own axes.
int kind(const BindingTarget& to) {
  return !to.goal.empty() ? 0 : !to.object.empty() ? 1 : !to.camera.empty() ? 2 : 3;
}

bool lies_in(const Axes& some, const Axes& all) {
  return (all.x || !some.x) && (all.y || !some.y) && (all.z || !some.z) && (all.rx || !some.rx) &&
         (all.ry || !some.ry) && (all.rz || !some.rz);
}

Status check_axes(const Axes& axes, const Axes& possible, const std::string& what) {
  if (!lies_in(axes, possible)) {
    return Error{"invalid_params", what + (possible.moves() ? " does not turn" : " has no place that could move"),
                 "/axes", possible.moves() ? "name some of x y z" : "name some of rx ry rz"};
  }
  if (!axes.moves() && !axes.turns())
    return Error{"invalid_params", "the binding moves nothing along no axis", "/axes", "name some of x y z rx ry rz"};
  return Ok{};
}

Status check_buttons(const Binding& binding) {
  std::uint32_t seen = 0;
  for (std::size_t i = 0; i < binding.buttons.size(); ++i) {
    const ButtonAction& action = binding.buttons[i];
    const std::string path = "/buttons/" + std::to_string(i);
    if (!(action.button >= 0 && action.button <= kMaxButton))
      return Error{"out_of_range", "no sensor has so many buttons", path + "/button", "0 is the first, to 31"};
    const std::string name = "button " + std::to_string(action.button);
    if (binding.clutch && binding.clutch->button == action.button)
      return Error{"invalid_params", name + " is the clutch", path + "/button", "take another one"};
    if (seen >> action.button & 1u)
      return Error{"invalid_params", name + " does something already", path + "/button", "name each button once"};
    seen |= 1u << action.button;
    if (action.act == ButtonAction::Do::recenter && binding.mode != Binding::Mode::relative)
      return Error{"invalid_params", "an absolute binding has no centre: its target is where the sensor is",
                   path + "/do", R"("mode":"relative", or "do":"toggle")"};
  }
  return Ok{};
}

Status check_numbers(Binding& binding) {
  if (!(std::abs(binding.scale) <= 1000.0))
    return Error{"out_of_range", "the scale is out of range", "/scale", "-1000 to 1000"};
  if (binding.clutch && !(binding.clutch->button >= 0 && binding.clutch->button <= kMaxButton))
    return Error{"out_of_range", "no sensor has so many buttons", "/clutch/button", "0 is the first, to 31"};
  if (const Status checked = check_buttons(binding); !checked) return checked;
  if (SensorOffset* offset = binding.offset ? &*binding.offset : nullptr) {
    for (int i = 0; i < 3; ++i) {
      if (!(std::abs(offset->position[i]) <= kMaxOffset))
        return Error{"out_of_range", "the offset is too long", "/offset/position/" + std::to_string(i),
                     "within 100 m, in the sensor's frame"};
    }
    const double length = glm::length(offset->rotation);
    if (!(std::abs(length - 1.0) <= 1e-3))
      return Error{"invalid_params", "the quaternion is not of unit length", "/offset/quat_xyzw",
                   "x y z w, with x²+y²+z²+w² = 1"};
    if (std::abs(length - 1.0) > 1e-15) offset->rotation = offset->rotation / length;
  }
  if (!binding.filter) return Ok{};
  if (!within(binding.filter->predict_ms, 0.0, kMaxPredict))
    return Error{"out_of_range", "the prediction is out of range", "/filter/predict_ms", "0 to 100 ms"};
  if (const auto& filter = binding.filter->one_euro) {
    if (!within(filter->min_cutoff_hz, 1e-3, kMaxCutoff))
      return Error{"out_of_range", "the cutoff is out of range", "/filter/one_euro/min_cutoff_hz", "0.001 to 1000 Hz"};
    if (!within(filter->beta, 0.0, kMaxBeta))
      return Error{"out_of_range", "beta is out of range", "/filter/one_euro/beta", "0 to 10000"};
    if (!within(filter->d_cutoff_hz, 1e-3, kMaxCutoff))
      return Error{"out_of_range", "the cutoff is out of range", "/filter/one_euro/d_cutoff_hz", "0.001 to 1000 Hz"};
  }
  return Ok{};
}

}  // namespace

Status Scene::check_bindable(const SceneGoal& goal, const Axes& axes) {
  const bool moves = position_of(goal.goal.payload), turns = rotation_of(goal.goal.payload);
  if (!moves && !turns) {
    return Error{"invalid_params",
                 "goal " + goal.goal.id + " is of kind " + name_of(kind_of(goal.goal.payload)) +
                     ": it has no place that a sensor could move",
                 "/to/goal", "bind a position, orientation or pose goal; another may be relative_to the sensor"};
  }
  if (goal.goal.relative_to.kind != GoalBase::Kind::world) {
    return Error{"not_available", "goal " + goal.goal.id + " is not relative to the world: no sensor moves it yet",
                 "/to/goal", "\"relative_to\":\"world\""};
  }
  return check_axes(axes, moves && turns ? kAllAxes : moves ? kMoves : kTurns, "goal " + goal.goal.id);
}

// All that the target can follow. Errors: there is none, or it does not move.
Result<Axes> Scene::axes_of(const BindingTarget& to) const {
  if (!to.goal.empty()) {
    const auto goal = goals_.find(to.goal);
    if (goal == goals_.end()) return unknown("goal", to.goal, keys(goals_), "/to/goal");
    const bool moves = position_of(goal->second.goal.payload), turns = rotation_of(goal->second.goal.payload);
    return moves && turns ? kAllAxes : turns ? kTurns : kMoves;
  }
  if (!to.object.empty()) {
    if (!objects_.contains(to.object)) return unknown("object", to.object, keys(objects_), "/to/object");
    return kAllAxes;
  }
  if (to.camera.empty()) return kTurns;
  const auto camera = cameras_.find(to.camera);
  if (camera == cameras_.end()) return unknown("camera", to.camera, keys(cameras_), "/to/camera");
  if (camera->second.camera.relative_to.kind != GoalBase::Kind::world) {
    return Error{"not_available", "camera " + to.camera + " is not relative to the world: no sensor moves it yet",
                 "/to/camera", "\"relative_to\":\"world\""};
  }
  return kAllAxes;
}

// Resolves what is bound: the joint, and the axes where they were not said.
Status Scene::find_target(SceneBinding& made) const {
  BindingTarget& to = made.binding.to;
  if (!to.joint.empty()) {
    const Result<const SceneFigure*> figure = find_figure(to.figure);
    if (!figure) return below("/to", figure.error());
    to.figure = (*figure)->entry.id;
    const BodyTree& tree = *(*figure)->tree;
    const Result<int> joint = find_joint(tree, to.joint);
    if (!joint) return below("/to/joint", joint.error());
    made.joint = *joint;
    if (const JointType type = tree.joint(*joint).type; !turns(type) && type != JointType::hinge) {
      return Error{"invalid_params", "joint " + to.joint + " does not turn about an axis or a point", "/to/joint",
                   *joint == 0 ? "a pose goal of the root's segment can be bound" : "bind a ball, universal or hinge"};
    }
  }
  const Result<Axes> possible = axes_of(to);
  if (!possible) return possible.error();
  if (!made.binding.axes) made.binding.axes = *possible;
  if (const auto goal = goals_.find(to.goal); goal != goals_.end())
    return check_bindable(goal->second, *made.binding.axes);
  return check_axes(*made.binding.axes, *possible, name(to));
}

Result<SceneBinding> Scene::make_binding(Binding binding) const {
  if (const Status checked = check_numbers(binding); !checked) return checked.error();
  const Result<SensorName> sensor = read_sensor(binding.sensor);
  if (!sensor) return sensor.error();
  SceneBinding made;
  made.sensor = *sensor;
  made.binding = std::move(binding);
  made.revision = 1;
  if (const Status found = find_target(made); !found) return found.error();
  for (const auto& [id, other] : bindings_) {
    if (id != made.binding.id && other.binding.to == made.binding.to) {
      return Error{"invalid_params", name(made.binding.to) + " is already moved by binding " + id,
                   path(made.binding.to), "remove that binding first"};
    }
  }
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
  // Another kind of target begins with all that it can follow.
  if (edit.to && (before == bindings_.end() || kind(*edit.to) != kind(binding.to))) binding.axes.reset();
  if (edit.to) binding.to = *edit.to;
  if (edit.axes.is_reset()) binding.axes.reset();
  if (edit.axes.value()) binding.axes = *edit.axes.value();
  edit.mode.apply(binding.mode);
  if (edit.clutch.is_reset()) binding.clutch.reset();
  if (edit.clutch.value()) binding.clutch = *edit.clutch.value();
  edit.buttons.apply(binding.buttons);
  edit.scale.apply(binding.scale, 1.0);
  if (edit.offset.is_reset()) binding.offset.reset();
  if (edit.offset.value()) binding.offset = *edit.offset.value();
  if (edit.filter.is_reset()) binding.filter.reset();
  if (edit.filter.value()) binding.filter = *edit.filter.value();
  edit.label.apply(binding.label);
  edit.user.apply(binding.user);

  Result<SceneBinding> made = make_binding(std::move(binding));
  if (!made) return made.error();
  made->revision = next_revision(&Change::bindings, bindings_, id);
  // Other axes: those that are followed no more stay where the sensor left them.
  if (before != bindings_.end() &&
      (before->second.binding.to != made->binding.to || before->second.binding.axes != made->binding.axes))
    let_go(before->second);
  const Revision revision = made->revision;
  keep_binding(id);
  bindings_.insert_or_assign(id, std::move(*made));
  return Edited{id, count(), revision};
}

Result<Edited> Scene::remove_binding(const std::string& id, IfRevision if_revision) {
  const auto found = bindings_.find(id);
  if (found == bindings_.end()) return unknown("binding", id, keys(bindings_), "/id");
  if (const auto error = stale(bindings_, id, if_revision)) return *error;
  let_go(found->second);
  keep_binding(id);
  bindings_.erase(found);
  return Edited{id, count(), 0};
}

// What a new figure under the id makes of bindings to its joints. Errors: a joint is gone.
Result<std::map<std::string, SceneBinding>> Scene::refit_bindings(const std::string& figure,
                                                                  const SceneFigure& next) const {
  std::map<std::string, SceneBinding> fitted;
  for (const auto& [id, binding] : bindings_) {
    const BindingTarget& to = binding.binding.to;
    if (to.joint.empty() || to.figure != figure) continue;
    const auto joint = next.tree->find_joint(to.joint);
    const auto type = joint ? next.tree->joint(*joint).type : JointType::fixed;
    if (!turns(type) && type != JointType::hinge) {
      return Error{"unknown_joint", "binding " + id + " does not fit the new figure: it has no such joint " + to.joint,
                   "/id", "remove the binding first"};
    }
    SceneBinding& again = fitted.emplace(id, binding).first->second;
    again.joint = *joint;
    again.anchor.reset();
    again.rest.reset();
    again.moves_joint = false;
  }
  return fitted;
}

}  // namespace posed
