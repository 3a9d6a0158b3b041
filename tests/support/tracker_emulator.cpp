#include "tests/support/tracker_emulator.h"

#include <cmath>
#include <numbers>

namespace posed::test {

void rotation_of(const SourcePose& pose, double q[4]) {
  const double to_half = std::numbers::pi / 360.0;
  const double ca = std::cos(pose.azimuth * to_half), sa = std::sin(pose.azimuth * to_half);
  const double ce = std::cos(pose.elevation * to_half), se = std::sin(pose.elevation * to_half);
  const double cr = std::cos(pose.roll * to_half), sr = std::sin(pose.roll * to_half);
  q[0] = ca * ce * cr + sa * se * sr;
  q[1] = ca * ce * sr - sa * se * cr;
  q[2] = ca * se * cr + sa * ce * sr;
  q[3] = sa * ce * cr - ca * se * sr;
}

void matrix_of(const SourcePose& pose, double m[9]) {
  const double to_radians = std::numbers::pi / 180.0;
  const double a = pose.azimuth * to_radians, e = pose.elevation * to_radians, r = pose.roll * to_radians;
  const double CA = std::cos(a), SA = std::sin(a), CE = std::cos(e), SE = std::sin(e), CR = std::cos(r),
               SR = std::sin(r);
  const double rows[9] = {CA * CE,
                          CA * SE * SR - SA * CR,
                          CA * SE * CR + SA * SR,
                          SA * CE,
                          CA * CR + SA * SE * SR,
                          SA * SE * CR - CA * SR,
                          -SE,
                          CE * SR,
                          CE * CR};
  for (int i = 0; i < 9; ++i) m[i] = rows[i];
}

SourcePose mirrored(SourcePose pose, const double zenith[3]) {
  const bool tracking = zenith[0] == 0 && zenith[1] == 0 && zenith[2] == 0;
  if (!tracking && pose.x * zenith[0] + pose.y * zenith[1] + pose.z * zenith[2] < 0) {
    pose.x = -pose.x;
    pose.y = -pose.y;
    pose.z = -pose.z;
  }
  return pose;
}

}  // namespace posed::test
