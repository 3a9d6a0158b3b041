// A position goal as the reach tree's solver takes it: a point of a segment that is pulled to a place in the world
// (paper, "Body representation": goal location and weight).
#pragma once

#include <algorithm>

#include "common/goal.h"
#include "common/math.h"

namespace posed {

struct ReachGoal {
  int segment = 0;
  Vec3 point{0.0, 0.0, 0.0};   // segment's frame, m
  Vec3 target{0.0, 0.0, 0.0};  // world, m
  double weight = 10.0;        // 0 (or less, or not a number) is off
  GoalTolerance tolerance;     // a box has the world's axes
  bool enabled = true;
};

// Whatever arrives, the solver's arithmetic stays finite: farther targets count as so far away along each axis (m),
// heavier goals as so heavy, and a target that is no point at all turns its goal off.
inline constexpr double kFarthest = 1e6;
inline constexpr double kHeaviest = 1e12;

// The weight that the goal pulls with; 0: it is off.
inline double pull_of(const ReachGoal& goal) {
  return goal.enabled && goal.weight > 0.0 && finite(goal.target) ? std::min(goal.weight, kHeaviest) : 0.0;
}

inline Vec3 target_of(const ReachGoal& goal) {
  return {std::clamp(goal.target.x, -kFarthest, kFarthest), std::clamp(goal.target.y, -kFarthest, kFarthest),
          std::clamp(goal.target.z, -kFarthest, kFarthest)};
}

}  // namespace posed
