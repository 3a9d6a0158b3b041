#include "common/math.h"

namespace posed {

Vec3 perpendicular(const Vec3& v, const Vec3& wish) {
  const double length2 = glm::dot(v, v);
  if (length2 == 0.0) return glm::dot(wish, wish) > 0.0 ? glm::normalize(wish) : kX;
  const Vec3 candidates[] = {wish, kX, kY, kZ};
  for (const Vec3& c : candidates) {
    const Vec3 p = c - v * (glm::dot(c, v) / length2);
    if (glm::dot(p, p) > 1e-12 * glm::dot(c, c) && glm::dot(p, p) > 0.0) return glm::normalize(p);
  }
  return kX;
}

Quat shortest_arc(const Vec3& from, const Vec3& to, const Vec3& fallback) {
  const double scale = std::sqrt(glm::dot(from, from) * glm::dot(to, to));
  if (!(scale > 0.0)) return quat_identity();
  const double cosine = glm::dot(from, to) / scale;
  // Half-way form: exact for small angles. Close to a half turn its axis is noise, so the axis is chosen instead.
  if (cosine < -1.0 + 1e-14) return quat_about(perpendicular(from, fallback), M_PI);
  const Vec3 axis = glm::cross(from, to) / scale;
  return glm::normalize(Quat(1.0 + cosine, axis.x, axis.y, axis.z));
}

}  // namespace posed
