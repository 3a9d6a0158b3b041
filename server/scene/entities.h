// The entities of a scene: their documents, with names resolved, and what sensors and the solver say of them. Plain
// values.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/scene.h"
#include "server/scene/binding_motion.h"
#include "server/scene/motion_filter.h"
#include "server/scene/sensor_name.h"
#include "server/solver/body_tree.h"
#include "server/solver/spring_goal.h"

namespace posed {

using Revision = std::uint64_t;

// Names what an entity says: the scene's revision that made it so. An edit that is taken back brings the number back.
using Content = std::uint64_t;
inline constexpr Content kAtStart = ~Content{0};

struct EntityState {
  Revision revision = 0;       // the entity's own; only grows
  Content content = kAtStart;  // never 0
};

struct SceneFigure : EntityState {
  FigureEntry entry;  // its q is empty: the values are in `q`
  std::shared_ptr<const BodyTree> tree;
  std::vector<double> q;
  Content pose = kAtStart;   // the last edit that had to do with it, its goals among that
  Content posed = kAtStart;  // the last edit that said its joint values
};

// Of what the payload has of the two.
inline void place_payload(const Transform& place, GoalPayload& payload) {
  if (Vec3* position = position_of(payload)) *position = place.position;
  if (Quat* rotation = rotation_of(payload)) *rotation = place.rotation;
}
inline Transform place_of(const GoalPayload& payload) {  // what it lacks is at rest
  const Vec3* position = position_of(payload);
  const Quat* rotation = rotation_of(payload);
  return {position ? *position : kZero, rotation ? *rotation : quat_identity()};
}

struct SceneGoal : EntityState {
  Goal goal;
  AttachedPoint at;        // of kinds that take hold
  Spring spring;           // the payload, its names resolved
  int base_segment = -1;   // relative to a segment: which, of the figure goal.relative_to.figure
  SensorName base_sensor;  // relative to a sensor
  // What sensors say; no part of the document.
  std::optional<Transform> live;             // where a bound sensor has it, in the world; of the payload's parts
  std::optional<Transform> world_from_base;  // relative to an object, or to a sensor that has been heard
  bool base_moves = false;                   // sensors move the base

  Transform place() const { return live ? *live : place_of(goal.payload); }  // position, orientation and pose goals
  Vec3 target() const { return place().position; }
  bool follows_sensors() const { return live || base_moves; }
  bool rides_on(const std::string& object) const {
    return goal.relative_to.kind == GoalBase::Kind::object && goal.relative_to.object == object;
  }
};

struct SceneObject : EntityState {
  Object object;                  // its rotation has unit length
  std::optional<Transform> live;  // where a bound sensor has it; no part of the document

  const Transform& world_from_object() const { return live ? *live : object.world_from_object; }
};

struct SceneCamera : EntityState {
  Camera camera;           // its rotation has unit length
  int base_segment = -1;   // relative to a segment: which, of the figure camera.relative_to.figure
  SensorName base_sensor;  // relative to a sensor
  // What sensors say; no part of the document.
  std::optional<Transform> live;             // where a bound sensor has it, in the world
  std::optional<Transform> world_from_base;  // relative to an object, or to a sensor that has been heard

  bool rides_on(const std::string& object) const {
    return camera.relative_to.kind == GoalBase::Kind::object && camera.relative_to.object == object;
  }
};

struct SceneBinding : EntityState {
  Binding binding;  // its axes are said, and a joint's figure
  SensorName sensor;
  int joint = -1;  // of a joint: which, of the figure binding.to.figure
  // What the sensor says; no part of the document.
  MotionFilter filter;                 // where the binding has one
  std::optional<MotionAnchor> anchor;  // relative mode: where both stood when the motion began
  std::optional<Transform> rest;       // of a joint: how its segment lay in the world at the first sample
  std::array<double, 4> share{};       // of a joint: its share of q, where `moves_joint`
  bool moves_joint = false;
  std::uint32_t held = ~0u;  // buttons; one that is held from the beginning was not pressed
  bool paused = false;       // by a button
};

}  // namespace posed
