#include "server/tracker/axes.h"

#include <cmath>
#include <numbers>

namespace posed::tracker {
namespace {

// The useful range is 1.8 m; an alignment frame may shift the origin some way from the source.
constexpr double kFarthest = 20.0;

}  // namespace

Quat quat_from_angles(double azimuth, double elevation, double roll) {
  return quat_about(kZ, azimuth) * quat_about(kY, elevation) * quat_about(kX, roll);
}

bool take_position(const Vec3& source_metres, Sample& sample) {
  sample.position = world_from_source(source_metres);
  return finite(sample.position) && std::abs(sample.position.x) < kFarthest &&
         std::abs(sample.position.y) < kFarthest && std::abs(sample.position.z) < kFarthest;
}

bool take_angles(const Vec3& degrees, Sample& sample) {
  // One degree of slack: the ranges are closed, and rounding may step over their ends.
  if (!finite(degrees) || std::abs(degrees.x) > 181 || std::abs(degrees.y) > 91 || std::abs(degrees.z) > 181) {
    return false;
  }
  const Vec3 radians = degrees * (std::numbers::pi / 180.0);
  sample.rotation = world_from_source(quat_from_angles(radians.x, radians.y, radians.z));
  return true;
}

bool take_quaternion(const Quat& source, Sample& sample, double tolerance) {
  if (!finite(source)) return false;
  const double length = glm::length(source);
  if (!(std::abs(length - 1.0) <= tolerance)) return false;
  sample.rotation = world_from_source(source / length);
  return true;
}

}  // namespace posed::tracker
