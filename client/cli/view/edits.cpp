#include "client/cli/view/edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "client/cli/view/words.h"

namespace posed::view {
namespace {

constexpr double kLeastWeight = 0.01, kMostWeight = 1e6;

std::string json(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

std::string json(const Vec3& v) {
  return '[' + json(v.x) + ',' + json(v.y) + ',' + json(v.z) + ']';
}

std::string payload_json(const GoalPayload& payload) {
  if (const Vec3* position = position_of(payload)) return "\"position\":" + json(*position);
  if (const auto* aim = std::get_if<AimTarget>(&payload))
    return "\"aim\":{\"axis\":" + json(aim->axis) + ",\"point\":" + json(*aim->point) + '}';
  if (const auto* plane = std::get_if<PlaneTarget>(&payload)) {
    const char* side = plane->side == PlaneTarget::Side::above ? "above" : "on";
    return "\"plane\":{\"point\":" + json(plane->point) + ",\"normal\":" + json(plane->normal) + ",\"side\":\"" + side +
           "\"}";
  }
  const auto& line = std::get<LineTarget>(payload);
  return "\"line\":{\"point\":" + json(line.point) + ",\"direction\":" + json(line.direction) + '}';
}

// Ids and gestures have no character that JSON would escape.
Edit goal_set(const Goal& goal, const std::string& fields, const std::string& gesture) {
  std::string params = "{\"id\":\"" + goal.id + "\"," + fields;
  if (!gesture.empty()) params += ",\"gesture\":\"" + gesture + '"';
  const std::string field = fields.substr(0, fields.find(':'));
  return {"goal.set", params + '}', gesture.empty() ? "" : goal.id + field + gesture};
}

// world_from_base, as far as we know it.
Result<Quat> base_rotation(const Goal& goal, const Station& station) {
  const GoalBase& base = goal.relative_to;
  if (base.kind == GoalBase::Kind::world) return quat_identity();
  if (base.kind == GoalBase::Kind::object) {
    for (const Object& object : station.entities->objects)
      if (object.id == base.object) return station.world_from_object(object).rotation;
  }
  if (base.kind == GoalBase::Kind::segment && station.pose) {
    const std::string& id = base.figure.empty() ? goal.figure : base.figure;
    const auto figure = station.entities->figures.find(id);
    for (const proto::FigurePose& pose : station.pose->figures) {
      if (pose.figure != id || figure == station.entities->figures.end()) continue;
      const auto& segments = figure->second.document.segments;
      for (std::size_t i = 0; i < segments.size() && i < pose.world_from_segment.size(); ++i)
        if (segments[i].name == base.segment) return pose.world_from_segment[i].rotation;
    }
  }
  return Error{"not_available", goal_name(goal.id) + " is relative to something whose axes are not known here", "", ""};
}

}  // namespace

Vec3* handle_of(GoalPayload& payload) {
  if (Vec3* position = position_of(payload)) return position;
  if (auto* aim = std::get_if<AimTarget>(&payload)) return aim->point ? &*aim->point : nullptr;
  if (auto* plane = std::get_if<PlaneTarget>(&payload)) return &plane->point;
  if (auto* line = std::get_if<LineTarget>(&payload)) return &line->point;
  return nullptr;
}

Status nudge(Goal& goal, const Vec3& delta, const Station& station) {
  Vec3* handle = handle_of(goal.payload);
  if (handle == nullptr)
    return Error{"not_available",
                 std::string("a goal of kind ") + name_of(kind_of(goal.payload)) + " has no place to move", "", ""};
  if (const Binding* binding = station.entities->bound_to(goal.id))
    return Error{"not_available", goal_name(goal.id) + " is led by " + binding->sensor, "", ""};
  const auto rotation = base_rotation(goal, station);
  if (!rotation) return rotation.error();
  // Micrometres are enough, and keep numbers short that are moved to and fro.
  const Vec3 to = *handle + glm::conjugate(*rotation) * delta;
  for (int i = 0; i < 3; ++i) (*handle)[i] = std::round(to[i] * 1e6) / 1e6 + 0.0;
  return Ok{};
}

GoalWeight notched(const GoalWeight& weight, bool up) {
  const auto notch = [up](double value) {
    const double notches = std::round(10.0 * std::log10(std::clamp(value, kLeastWeight, kMostWeight))) + (up ? 1 : -1);
    const double next = std::clamp(std::pow(10.0, notches / 10.0), kLeastWeight, kMostWeight);
    const double unit = std::pow(10.0, std::floor(std::log10(next)) - 1.0);
    return std::round(next / unit) * unit;  // two digits are as fine as a hand sets it
  };
  GoalWeight next(notch(weight.value));
  if (weight.orientation) next.orientation = notch(*weight.orientation);
  return next;
}

Edit move_edit(const Goal& goal, const std::string& gesture) {
  return goal_set(goal, payload_json(goal.payload), gesture);
}

Edit weight_edit(const Goal& goal, const std::string& gesture) {
  const GoalWeight& w = goal.weight;
  const std::string text = w.orientation
                               ? "{\"position\":" + json(w.value) + ",\"orientation\":" + json(*w.orientation) + '}'
                               : json(w.value);
  return goal_set(goal, "\"weight\":" + text, gesture);
}

Edit enabled_edit(const Goal& goal) {
  return goal_set(goal, std::string("\"enabled\":") + (goal.enabled ? "true" : "false"), "");
}

}  // namespace posed::view
