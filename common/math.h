// Vectors, quaternions and rigid transforms: GLM in double precision. SI units, right-handed, Z up, X forward, Y left.
// Quaternions are Hamilton. GLM's constructor takes w first and the wire x first, so neither is written out by hand:
// use quat_from_xyzw and xyzw.
#pragma once

#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace posed {

using Vec3 = glm::dvec3;
using Quat = glm::dquat;

inline constexpr Vec3 kZero{0.0, 0.0, 0.0};
inline constexpr Vec3 kX{1.0, 0.0, 0.0};
inline constexpr Vec3 kY{0.0, 1.0, 0.0};
inline constexpr Vec3 kZ{0.0, 0.0, 1.0};

inline Quat quat_identity() {
  return Quat(1.0, 0.0, 0.0, 0.0);
}
inline Quat quat_from_xyzw(double x, double y, double z, double w) {
  return Quat(w, x, y, z);
}
inline Quat quat_from_xyzw(std::span<const double> v) {
  return Quat(v[3], v[0], v[1], v[2]);
}
inline std::array<double, 4> xyzw(const Quat& q) {
  return {q.x, q.y, q.z, q.w};
}

// The rotation by `angle` (rad) about the unit vector `axis`.
inline Quat quat_about(const Vec3& axis, double angle) {
  const double s = std::sin(0.5 * angle);
  return Quat(std::cos(0.5 * angle), s * axis.x, s * axis.y, s * axis.z);
}

// A rigid motion; `world_from_segment` maps points of the segment's frame to the world.
struct Transform {
  Vec3 position{0.0, 0.0, 0.0};
  Quat rotation{1.0, 0.0, 0.0, 0.0};

  Vec3 operator*(const Vec3& point) const { return position + rotation * point; }
  Transform operator*(const Transform& b) const { return {position + rotation * b.position, rotation * b.rotation}; }
};

inline Transform inverse(const Transform& t) {
  const Quat r = glm::conjugate(t.rotation);
  return {-(r * t.position), r};
}

inline bool finite(double v) {
  return std::isfinite(v);
}
inline bool finite(const Vec3& v) {
  return finite(v.x) && finite(v.y) && finite(v.z);
}
inline bool finite(const Quat& q) {
  return finite(q.x) && finite(q.y) && finite(q.z) && finite(q.w);
}

// `b` or `-b`, whichever is nearer to `a`: the same rotation with a sign that does not jump.
inline Quat same_sign(const Quat& a, const Quat& b) {
  return glm::dot(a, b) < 0.0 ? -b : b;
}

// The smallest rotation that takes the direction of `from` to that of `to`. Where they are opposite it turns about
// `fallback` (made perpendicular to `from`; any axis if that fails too); where either is zero it is the identity.
Quat shortest_arc(const Vec3& from, const Vec3& to, const Vec3& fallback);

// A unit vector perpendicular to `v` and as near to `wish` as can be; deterministic where `wish` is parallel to `v`.
Vec3 perpendicular(const Vec3& v, const Vec3& wish);

}  // namespace posed
