// From joint values to world transforms.
//
// q is one array of doubles, joint after joint in the order of the segments (BodyTree::q_at):
//   free                  7  position (m) and quat_xyzw
//   ball, universal       4  quat_xyzw
//   hinge, prismatic      1  rad about, or m along, axes[0]
//   fixed                 0
// world_from_segment = world_from_parent * parent_from_joint * motion(q). The root's free joint is the exception: its q
// is the root's pose in the world itself, world_from_root = {position, quat}; at rest that is its parent_from_joint.
#pragma once

#include <span>

#include "common/math.h"
#include "common/result.h"
#include "server/solver/body_tree.h"

namespace posed {

// World transform of segment i, given its parent's (ignored for the root).
Transform place_segment(const BodyTree& tree, int i, std::span<const double> q, const Transform& world_from_parent);

// How segment i lies in the world. Does not allocate.
Quat world_rotation(const BodyTree& tree, int i, std::span<const double> q);

// The reach tree's solver bends these freely.
inline constexpr bool bends_as_ball(JointType type) {
  return type == JointType::ball || type == JointType::universal;
}

// q of q_size() values with unit quaternions -> size() transforms. Does not allocate.
void forward_kinematics(const BodyTree& tree, std::span<const double> q, std::span<Transform> world_from_segment);

// Calls f(first) for each quaternion in q: its four values begin at index `first`.
template <class F>
void each_quaternion(const BodyTree& tree, F f) {
  for (int i = 0; i < tree.size(); ++i) {
    const int size = q_size(tree.joint(i).type);
    if (size >= 4) f(static_cast<std::size_t>(tree.q_at(i) + size - 4));
  }
}

// Makes each quaternion of q unit length.
void normalise_quaternions(const BodyTree& tree, std::span<double> q);

// Gives each quaternion of q the sign that is nearer to the one in `before`: the same pose, without a jump.
void keep_signs(const BodyTree& tree, std::span<const double> before, std::span<double> q);

// The right number of values, all finite, a root position within 1e6 m, quaternions of unit length to 1e-6.
// Errors: "invalid_params", "not_finite", "out_of_range"; path "/12" is the index in q.
Status check_q(const BodyTree& tree, std::span<const double> q);

}  // namespace posed
