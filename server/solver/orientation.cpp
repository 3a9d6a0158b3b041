#include "server/solver/orientation.h"

namespace posed {
namespace {

struct Axes {
  Vec3 p, q;
};

Axes axes_of(const Vec3& limb) {
  const Vec3 p = glm::dot(limb, limb) > 0.0 ? glm::normalize(limb) : kZ;
  const bool parallel = std::abs(glm::dot(p, kX)) > 1.0 - 1e-9;
  return {p, perpendicular(p, parallel ? kY : kX)};
}

double wrapped(double angle) {
  angle = std::remainder(angle, 2.0 * M_PI);
  return angle <= -M_PI ? M_PI : angle;
}

}  // namespace

Quat quat_from_orientation(const Orientation& o, const Vec3& limb) {
  const Axes a = axes_of(limb);
  return quat_about(a.p, o.halfplane) * quat_about(a.q, o.deviation) * quat_about(a.p, o.twist - o.halfplane);
}

Orientation orientation_from_quat(const Quat& quat, const Vec3& limb) {
  // In the frame p, q, p x q this is Euler p-q-p. With the quaternion's parts about p, q and r = p x q:
  //   (w, p) = cos(d/2) (cos, sin)(t/2),  (q, r) = sin(d/2) (cos, sin)(h - t/2)
  const Axes a = axes_of(limb);
  const Vec3 v(quat.x, quat.y, quat.z);
  const double p = glm::dot(v, a.p), q = glm::dot(v, a.q), r = glm::dot(v, glm::cross(a.p, a.q));
  const double about_p = std::hypot(quat.w, p), aside = std::hypot(q, r);
  Orientation o;
  o.deviation = 2.0 * std::atan2(aside, about_p);
  const double half_sum = about_p > 1e-12 ? std::atan2(p, quat.w) : 0.0;  // t / 2
  const double half_difference = aside > 1e-12 ? std::atan2(r, q) : 0.0;  // h - t / 2
  if (aside <= 1e-12) {
    o.deviation = 0.0;
    o.twist = wrapped(2.0 * half_sum);
  } else if (about_p <= 1e-12) {
    o.deviation = M_PI;
    o.twist = wrapped(-2.0 * half_difference);
  } else {
    o.halfplane = wrapped(half_sum + half_difference);
    o.twist = wrapped(2.0 * half_sum);
  }
  return o;
}

}  // namespace posed
