// Solve_simple_chain (paper, section of that name): a greedy reach by the triangle inequality.
//
// From the tip inward: the part of the chain that is beyond a joint is one straight stick; together with the link
// before the joint it makes a triangle with the target, if the target is neither too far nor too near. If it is, the
// joint is straightened (or folded), the two are one stick from now on, and the next joint inward has its turn. So a
// hand that its arm can carry to the target does not move the trunk. What no joint can bring closer goes to the nearest
// reachable distance.
#pragma once

#include <span>

#include "common/math.h"

namespace posed {

// A joint that bends as a ball; what is rigid between two of them is their link.
struct ChainJoint {
  Vec3 origin{0.0, 0.0, 0.0};                 // world, m, before the call
  Quat world_from_frame{1.0, 0.0, 0.0, 0.0};  // of the joint's frame at rest (the parent's side), before the call
  Vec3 bend_axis{0.0, 0.0, 0.0};              // in that frame; a straight limb bends about it; zero: no wish
  Quat rotation{1.0, 0.0, 0.0, 0.0};          // in and out: the joint's own motion
};

// `joints` from the base to the tip; only their `rotation` is changed. `tip` and `target` in the world. Returns where
// the tip comes to lie. Deterministic for links of no length and for exact opposition too; unit quaternions stay unit.
Vec3 solve_simple_chain(std::span<ChainJoint> joints, const Vec3& tip, const Vec3& target);

}  // namespace posed
