#include "server/solver/ball_angles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posed {
namespace {

constexpr double kQuarterTurn = 1e-9;  // cosine of y below which x and z are one angle

double beyond(double angle, const AngleRange& range) {
  return std::max({angle - range.max, range.min - angle, 0.0});
}

// What is left about z once x and y are taken off: exact, however badly x is known near a quarter turn of y.
double left_about_z(const Quat& turn, double x, double y) {
  const Quat rest = glm::conjugate(quat_about(kX, x) * quat_about(kY, y)) * turn;
  return 2.0 * std::atan2(rest.z, rest.w);
}

}  // namespace

double near_range(double angle, const AngleRange& range) {
  if (!std::isfinite(range.min) || !std::isfinite(range.max) || (angle >= range.min && angle <= range.max))
    return angle;
  return angle - 2.0 * M_PI * std::round((angle - 0.5 * (range.min + range.max)) / (2.0 * M_PI));
}

std::array<double, 3> ball_angles(const Quat& turn, const std::array<AngleRange, 3>& ranges) {
  const Vec3 z = turn * kZ;
  const double cosine = std::hypot(z.y, z.z), y = std::atan2(z.x, cosine);
  if (cosine < kQuarterTurn) {
    // All of it about z; what z's range can not take goes to x.
    const double all = near_range(left_about_z(turn, 0.0, y), ranges[2]);
    const double too_much = all - std::clamp(all, ranges[2].min, ranges[2].max);
    const double x = near_range(std::copysign(1.0, y) * too_much, ranges[0]);
    const double inside = std::clamp(x, ranges[0].min, ranges[0].max);
    return {inside, y, near_range(left_about_z(turn, inside, y), ranges[2])};
  }
  // The first two turns carry x to e1 and y to e2; what is left turns about z.
  const double sx = -z.y / cosine, cx = z.z / cosine;
  const Vec3 e1(cosine, sx * z.x, -cx * z.x), e2(0.0, cx, sx), turned = turn * kX;
  const double x = std::atan2(sx, cx), about_z = std::atan2(glm::dot(e2, turned), glm::dot(e1, turned));
  std::array<double, 3> best{}, triples[2] = {{x, y, about_z}, {x + M_PI, M_PI - y, about_z + M_PI}};
  double least = std::numeric_limits<double>::infinity();
  for (auto& triple : triples) {
    double out = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      triple[k] = near_range(triple[k], ranges[k]);
      out += beyond(triple[k], ranges[k]);
    }
    if (out < least) least = out, best = triple;
    if (out == 0.0) break;
  }
  return best;
}

}  // namespace posed
