#include "server/solver/kinematics.h"

#include <algorithm>
#include <cassert>

#include "server/solver/figure_check.h"

namespace posed {

Transform place_segment(const BodyTree& tree, int i, std::span<const double> q, const Transform& world_from_parent) {
  const Joint& joint = tree.joint(i);
  const double* share = q.data() + tree.q_at(i);
  const auto quat = [](const double* v) { return quat_from_xyzw(v[0], v[1], v[2], v[3]); };
  if (joint.type == JointType::free) return {{share[0], share[1], share[2]}, quat(share + 3)};
  const Transform& offset = joint.parent_from_joint;
  Transform out{world_from_parent * offset.position, world_from_parent.rotation};
  if (offset.rotation != quat_identity()) out.rotation = out.rotation * offset.rotation;
  switch (joint.type) {
    case JointType::ball:
    case JointType::universal:
      out.rotation = out.rotation * quat(share);
      break;
    case JointType::hinge:
      out.rotation = out.rotation * quat_about(joint.axes[0], share[0]);
      break;
    case JointType::prismatic:
      out.position += out.rotation * joint.axes[0] * share[0];
      break;
    case JointType::free:
    case JointType::fixed:
      break;
  }
  return out;
}

void forward_kinematics(const BodyTree& tree, std::span<const double> q, std::span<Transform> world_from_segment) {
  assert(static_cast<int>(q.size()) == tree.q_size());
  assert(static_cast<int>(world_from_segment.size()) == tree.size());
  world_from_segment[0] = place_segment(tree, 0, q, {});
  for (int i = 1; i < tree.size(); ++i) {
    world_from_segment[static_cast<std::size_t>(i)] =
        place_segment(tree, i, q, world_from_segment[static_cast<std::size_t>(tree.parent(i))]);
  }
}

Quat world_rotation(const BodyTree& tree, int i, std::span<const double> q) {
  Quat below = quat_identity();
  for (; i >= 0; i = tree.parent(i)) below = place_segment(tree, i, q, {}).rotation * below;
  return below;
}

void normalise_quaternions(const BodyTree& tree, std::span<double> q) {
  each_quaternion(tree, [&](std::size_t first) {
    const Quat given = quat_from_xyzw(q.subspan(first, 4));
    if (std::abs(glm::dot(given, given) - 1.0) < 1e-14) return;  // a second time changes nothing
    const auto r = xyzw(glm::normalize(given));
    std::copy(r.begin(), r.end(), q.begin() + static_cast<std::ptrdiff_t>(first));
  });
}

void keep_signs(const BodyTree& tree, std::span<const double> before, std::span<double> q) {
  each_quaternion(tree, [&](std::size_t first) {
    const auto r = xyzw(same_sign(quat_from_xyzw(before.subspan(first, 4)), quat_from_xyzw(q.subspan(first, 4))));
    std::copy(r.begin(), r.end(), q.begin() + static_cast<std::ptrdiff_t>(first));
  });
}

Status check_q(const BodyTree& tree, std::span<const double> q) {
  if (static_cast<int>(q.size()) != tree.q_size()) {
    return Error{"invalid_params", "q has " + std::to_string(q.size()) + " values", "",
                 "this figure has " + std::to_string(tree.q_size()) + ": see q_layout in figure.get"};
  }
  for (std::size_t k = 0; k < q.size(); ++k) {
    if (!finite(q[k]))
      return Error{"not_finite", "a value of q is not finite", std::string("/") + std::to_string(k), "give a number"};
    if (std::abs(q[k]) > 1e6) {
      return Error{"out_of_range", "a value of q is beyond 1e6", std::string("/") + std::to_string(k),
                   "give metres and radians"};
    }
  }
  for (int i = 0; i < tree.size(); ++i) {
    const int size = q_size(tree.joint(i).type);
    if (size < 4) continue;
    const auto first = static_cast<std::size_t>(tree.q_at(i) + size - 4);
    if (std::abs(glm::length(quat_from_xyzw(q.subspan(first, 4))) - 1.0) > kUnitTolerance) {
      return Error{"out_of_range", "the quaternion of joint " + tree.joint(i).name + " is not of unit length",
                   std::string("/") + std::to_string(first), "divide it by its length; no rotation is 0,0,0,1"};
    }
  }
  return Ok{};
}

}  // namespace posed
