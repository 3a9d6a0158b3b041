// From a Polhemus source's frame (X forward, Y right, Z down) to the world's (X forward, Y left, Z up), and the checks
// that tell a record from noise. Source: LIBERTY User Manual URM03PH156 Rev H, appendix A (angles, rotation). Pure;
// throws nothing.
#pragma once

#include "common/frame.h"

namespace posed::tracker {

inline constexpr double kMetresPerInch = 0.0254;
inline constexpr double kMetresPerCentimetre = 0.01;

// A half turn about X on both ends, so that an identity stays an identity.
inline Vec3 world_from_source(const Vec3& v) {
  return {v.x, -v.y, -v.z};
}
inline Quat world_from_source(const Quat& q) {
  return Quat(q.w, q.x, -q.y, -q.z);
}

// Azimuth about Z, elevation about the turned Y, roll about the twice turned X (rad; intrinsic Z-Y'-X'').
Quat quat_from_angles(double azimuth, double elevation, double roll);

// Each fills the sample in world axes; false where no device could have sent it: not finite, out of the instrument's
// reach, beyond an angle's range, off the unit sphere by more than `tolerance`.
bool take_position(const Vec3& source_metres, Sample& sample);
bool take_angles(const Vec3& degrees, Sample& sample);
bool take_quaternion(const Quat& source, Sample& sample, double tolerance = 1e-2);

}  // namespace posed::tracker
