#include "server/solver/simple_chain.h"

#include <algorithm>

namespace posed {
namespace {

// Below this sine a limb counts as straight: the plane that it bends in would be rounding, not posture.
constexpr double kStraight = 1e-6;
// Metres. A shorter link can not swing.
constexpr double kShortest = 1e-9;

Vec3 world_bend_axis(const ChainJoint& joint) {
  return joint.world_from_frame * joint.bend_axis;
}

void turn(ChainJoint& joint, const Quat& world_rotation, Vec3& tip) {
  const Quat in_frame = glm::conjugate(joint.world_from_frame) * world_rotation * joint.world_from_frame;
  joint.rotation = glm::normalize(in_frame * joint.rotation);
  tip = joint.origin + world_rotation * (tip - joint.origin);
}

void aim(ChainJoint& joint, Vec3& tip, const Vec3& target) {
  turn(joint, shortest_arc(tip - joint.origin, target - joint.origin, world_bend_axis(joint)), tip);
}

// Turns the stick beyond the joint until it deviates from `link`, the link before it, by `angle` in [0, pi].
void bend(ChainJoint& joint, const Vec3& link, Vec3& tip, double angle) {
  const Vec3 stick = tip - joint.origin;
  const Vec3 normal = glm::cross(link, stick);
  const double sine = glm::length(normal), cosine = glm::dot(link, stick);
  if (sine > kStraight * glm::length(link) * glm::length(stick)) {
    turn(joint, quat_about(normal / sine, angle - std::atan2(sine, cosine)), tip);
    return;
  }
  const Vec3 axis = perpendicular(link, world_bend_axis(joint));
  turn(joint, quat_about(axis, angle) * shortest_arc(stick, link, axis), tip);
}

}  // namespace

Vec3 solve_simple_chain(std::span<ChainJoint> joints, const Vec3& start, const Vec3& target) {
  Vec3 tip = start;
  if (joints.empty()) return tip;
  for (std::size_t i = joints.size() - 1; i > 0; --i) {
    const Vec3 link = joints[i].origin - joints[i - 1].origin;
    const double a = glm::length(link);
    const double r = glm::length(tip - joints[i].origin);
    if (a < kShortest || r < kShortest) continue;
    const double d = glm::length(target - joints[i - 1].origin);
    if (d > a + r) {
      bend(joints[i], link, tip, 0.0);
    } else if (d < std::abs(a - r)) {
      bend(joints[i], link, tip, M_PI);
    } else {
      // (d^2 - (a - r)^2) / 4ar as a product: no digits are lost where the triangle is nearly flat.
      const double c2 = (d - (a - r)) * (d + (a - r)) / (4.0 * a * r);  // cos^2 of half the angle
      bend(joints[i], link, tip, 2.0 * std::acos(std::sqrt(std::clamp(c2, 0.0, 1.0))));
      aim(joints[i - 1], tip, target);
      return tip;
    }
  }
  aim(joints[0], tip, target);
  return tip;
}

}  // namespace posed
