// From the scene to the solver `springs`.
#pragma once

#include <vector>

#include "server/scene/scene.h"
#include "server/solver/spring_goal.h"

namespace posed {

// The goal as the solver takes it, by the indices of its own figure. Of a goal that is relative to a segment of another
// figure (joins_figures), `world_from_base` says where that segment is; to others it means nothing. A goal relative to
// a sensor is off until the sensor has been heard.
SpringGoal spring_goal(const SceneGoal& goal, const Transform& world_from_base = {});

// Puts a position, orientation or pose where the place is; leaves others.
void place_spring(const Transform& place, Spring& spring);

// A joint that a sensor moves takes its value after all pins and before all goals.
inline constexpr int kJointPriority = -1000;
SpringGoal joint_spring(const SceneBinding& binding, const BodyTree& tree);
// Brings it up to date. Does not allocate.
void follow_sensor(const SceneBinding& binding, SpringGoal& spring);

// Brings up to date what sensors move, in a goal made by spring_goal. Does not allocate.
void follow_sensors(const SceneGoal& goal, SpringGoal& spring);

inline bool joins_figures(const SceneGoal& goal) {
  const GoalBase& base = goal.goal.relative_to;
  return base.kind == GoalBase::Kind::segment && base.figure != goal.goal.figure;
}

// The figure's pins, in the order of their segments' names: goals of kPinPriority relative to the world.
std::vector<SpringGoal> pin_goals(const SceneFigure& figure);

}  // namespace posed
