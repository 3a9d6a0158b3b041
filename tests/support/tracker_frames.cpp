#include "tests/support/tracker_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace posed::test {
namespace {

using Point = SensorFrames::Point;
using Matrix = SensorFrames::Matrix;

constexpr double kDegrees = 180.0 / std::numbers::pi;

Matrix times(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < 3; ++k) out[3 * r + c] += a[3 * r + k] * b[3 * k + c];
    }
  }
  return out;
}

Matrix transposed(const Matrix& a) {
  return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]};
}

Point times(const Matrix& a, const Point& p) {
  Point out{};
  for (std::size_t r = 0; r < 3; ++r) out[r] = a[3 * r] * p[0] + a[3 * r + 1] * p[1] + a[3 * r + 2] * p[2];
  return out;
}

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point unit(const Point& a) {
  const double length = std::hypot(a[0], a[1], a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

Matrix turned(const SourcePose& pose) {
  Matrix m{};
  matrix_of(pose, m.data());
  return m;
}

SourcePose pose_of(const Point& p, const Matrix& m) {
  return {p[0],
          p[1],
          p[2],
          kDegrees * std::atan2(m[3], m[0]),
          kDegrees * std::asin(std::clamp(-m[6], -1.0, 1.0)),
          kDegrees * std::atan2(m[7], m[8])};
}

}  // namespace

void SensorFrames::set_tip(const Point& tip) {
  tip_ = tip;
  plain_ = false;
}

void SensorFrames::align(const Point& origin, const Point& x, const Point& y) {
  plain_ = false;
  const Point forward = unit(minus(x, origin));
  const Point down = unit(cross(forward, minus(y, origin)));
  const Point right = cross(down, forward);
  const Point moved = times(axes_, origin);
  for (std::size_t i = 0; i < 3; ++i) origin_[i] += moved[i];
  axes_ =
      times(axes_, Matrix{forward[0], right[0], down[0], forward[1], right[1], down[1], forward[2], right[2], down[2]});
}

void SensorFrames::reset_alignment() {
  origin_ = {};
  axes_ = kIdentity;
}

SourcePose SensorFrames::aligned(const SourcePose& measured) const {
  const Matrix m = turned(measured);
  const Point tip = times(m, tip_);
  const Point place{measured.x + tip[0], measured.y + tip[1], measured.z + tip[2]};
  return pose_of(times(transposed(axes_), minus(place, origin_)), times(transposed(axes_), m));
}

void SensorFrames::boresight(const SourcePose& measured, const SourcePose& reference, bool origin) {
  plain_ = false;
  const SourcePose now = aligned(measured);
  bore_ = times(transposed(turned(now)), turned(reference));
  if (origin) bore_origin_ = {now.x, now.y, now.z};
}

void SensorFrames::reset_boresight() {
  bore_ = kIdentity;
  bore_origin_ = {};
}

SourcePose SensorFrames::of(const SourcePose& measured) const {
  if (plain_) return measured;
  const SourcePose now = aligned(measured);
  return pose_of(minus({now.x, now.y, now.z}, bore_origin_), times(turned(now), bore_));
}

}  // namespace posed::test
