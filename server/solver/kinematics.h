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

// The joint's motion for its share of q (not for a free joint).
Transform joint_motion(const Joint& joint, std::span<const double> share);

// World transform of segment i, given its parent's (ignored for the root).
Transform place_segment(const BodyTree& tree, int i, std::span<const double> q, const Transform& world_from_parent);

// q of q_size() values with unit quaternions -> size() transforms. Does not allocate.
void forward_kinematics(const BodyTree& tree, std::span<const double> q, std::span<Transform> world_from_segment);

// The right number of values, all finite, a root position within 1e6 m, quaternions of unit length to 1e-6.
// Errors: "invalid_params", "not_finite", "out_of_range"; path "/12" is the index in q.
Status check_q(const BodyTree& tree, std::span<const double> q);

}  // namespace posed
