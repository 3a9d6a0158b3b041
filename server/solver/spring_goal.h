// What the spring solver is given: goals whose names have been resolved to segments and points. One kind a goal.
//
// cost = sum over the goals of weight x error squared. Vectors are in the frame that the goal is relative to (its base)
// unless said; an angle counts as arc on the figure's lever. Directions are of unit length, quaternions too.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "common/goal.h"
#include "common/math.h"
#include "server/solver/body_tree.h"

namespace posed {

// The touch point goes to `position`. Error: the vector between, m.
struct PositionSpring {
  Vec3 position{0.0, 0.0, 0.0};
};
// The segment's frame turns as `rotation` (base_from_segment). Error: rotation vector x lever.
struct OrientationSpring {
  Quat rotation{1.0, 0.0, 0.0, 0.0};
};
struct PoseSpring {
  Vec3 position{0.0, 0.0, 0.0};
  Quat rotation{1.0, 0.0, 0.0, 0.0};
};
// `axis` (segment's frame), seen from the touch point, points at the point `to` or along the direction `to`.
// Error: angle x lever.
struct AimSpring {
  Vec3 axis{1.0, 0.0, 0.0};
  bool at_point = false;
  Vec3 to{1.0, 0.0, 0.0};
};
// The touch point lies on the plane, or on that side of it to which `normal` points. Error: distance.
struct PlaneSpring {
  Vec3 point{0.0, 0.0, 0.0};
  Vec3 normal{0.0, 0.0, 1.0};
  bool above = false;
};
// The touch point lies on the line. Error: distance.
struct LineSpring {
  Vec3 point{0.0, 0.0, 0.0};
  Vec3 direction{1.0, 0.0, 0.0};
};
// The touch point is `length` away from `to`, a point of another segment; or at least, or at most so far. Error: what
// is wanting or too much.
struct DistanceSpring {
  enum class Compare { equal, at_least, at_most };
  AttachedPoint to;  // of SpringGoal::base_figure
  double length = 0.0;
  Compare compare = Compare::equal;
};
// The centre of mass stands `margin` inside the convex hull of these points, seen from above (the segments' own mass
// is what counts). Error: how far it is outside, m.
struct BalanceSpring {
  std::vector<AttachedPoint> support;
  double margin = 0.0;
};
// Joints take these values. Error: angle x lever (prismatic: m), one error a joint.
struct PostureSpring {
  std::vector<int> joints;     // by their segments; their shares stand one after the other in `values`
  std::vector<double> values;  // as in q
};

using Spring = std::variant<PositionSpring, OrientationSpring, PoseSpring, AimSpring, PlaneSpring, LineSpring,
                            DistanceSpring, BalanceSpring, PostureSpring>;

struct SpringGoal {
  int figure = 0;    // of those that are solved as one
  AttachedPoint at;  // of kinds that take hold somewhere
  Spring spring;
  // The base. A base that moves with the figure is a segment: both ends of the goal then move. Else the goal is
  // relative to `world_from_base`, which is fixed while the solver runs (the world, an object, a sensor).
  int base_segment = -1;
  int base_figure = 0;  // that the segment, or a distance goal's other end, belongs to
  Transform world_from_base;
  double weight = 10.0;
  double orientation_weight = 10.0;  // of a pose goal's orientation; of no other kind
  // Lower is first: a goal never gives way to one of a higher number. Pins are goals of kPinPriority.
  int priority = 0;
  GoalTolerance tolerance;
  bool enabled = true;
};

inline constexpr int kPinPriority = std::numeric_limits<int>::min();

inline bool pulls(const SpringGoal& goal) {
  return goal.enabled &&
         (goal.weight > 0.0 || (std::holds_alternative<PoseSpring>(goal.spring) && goal.orientation_weight > 0.0));
}

}  // namespace posed
