#include "server/solver/ball_angles.h"

#include <algorithm>
#include <cmath>

namespace posed {
namespace {

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
  if (angle >= range.min && angle <= range.max) return angle;
  if (!std::isfinite(range.min) || !std::isfinite(range.max)) return angle;
  return angle - 2.0 * M_PI * std::round((angle - 0.5 * (range.min + range.max)) / (2.0 * M_PI));
}

void ball_tangents(const Quat& turn, double* y, double* x) {
  const Vec3 z = turn * kZ;
  const double cosine = std::sqrt(z.y * z.y + z.z * z.z);
  // The first two turns carry x to e1 and y to e2 (both times the cosine here); what is left turns about z.
  const Vec3 e1(cosine * cosine, -z.y * z.x, -z.z * z.x), e2(0.0, z.z, -z.y), turned = turn * kX;
  y[0] = -z.y, x[0] = z.z;
  y[1] = z.x, x[1] = cosine;
  y[2] = glm::dot(e2, turned), x[2] = glm::dot(e1, turned);
}

void choose_triple(const std::array<AngleRange, 3>& ranges, double* angles) {
  const auto apart = [&](double* triple) {
    double out = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      triple[k] = near_range(triple[k], ranges[k]);
      out += beyond(triple[k], ranges[k]);
    }
    return out;
  };
  double other[3] = {angles[0] + M_PI, M_PI - angles[1], angles[2] + M_PI};
  const double out = apart(angles);
  if (out > 0.0 && apart(other) < out) std::copy_n(other, 3, angles);
}

std::array<double, 3> ball_angles(const Quat& turn, const std::array<AngleRange, 3>& ranges) {
  double y[3], x[3];
  ball_tangents(turn, y, x);
  std::array<double, 3> angles{std::atan2(y[0], x[0]), std::atan2(y[1], x[1]), std::atan2(y[2], x[2])};
  if (x[1] >= kQuarterTurn) {
    choose_triple(ranges, angles.data());
    return angles;
  }
  // All of it about z; what z's range can not take goes to x.
  const double all = near_range(left_about_z(turn, 0.0, angles[1]), ranges[2]);
  const double too_much = all - std::clamp(all, ranges[2].min, ranges[2].max);
  const double turn_x = near_range(std::copysign(1.0, angles[1]) * too_much, ranges[0]);
  const double inside = std::clamp(turn_x, ranges[0].min, ranges[0].max);
  return {inside, angles[1], near_range(left_about_z(turn, inside, angles[1]), ranges[2])};
}

}  // namespace posed
