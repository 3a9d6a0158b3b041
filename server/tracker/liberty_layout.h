// The body of a LIBERTY data record: items in the order of the output list (command O).
// Source: LIBERTY User Manual URM03PH156 Rev H, table 2-19 (binary sizes), appendix A (angles, rotation).
// Pure; throws nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/frame.h"
#include "common/result.h"

namespace posed::tracker {

class LibertyLayout {
 public:
  // Error out_of_range: an unknown item, none for the position (2, 3) or none for the rotation (4, 5, 7).
  static Result<LibertyLayout> make(std::span<const int> items);

  std::size_t body_size() const { return body_size_; }
  bool counted() const { return counted_; }  // item 9, the frame count, is in the list

  // Fills position (m), rotation (both in world axes), buttons, the distortion flag, device_count and, from the
  // device's millisecond stamp, device_t_ns. `body` holds body_size() bytes, little-endian. False where no device could
  // have sent them: the literal bytes, a flag's range, a float that is not finite, a quaternion off the unit sphere, a
  // position out of the instrument's reach.
  bool decode(std::span<const std::uint8_t> body, double metres_per_unit, Sample& sample) const;

 private:
  LibertyLayout() = default;
  std::vector<int> items_;
  std::size_t body_size_ = 0;
  bool counted_ = false;
};

// Azimuth about Z, elevation about the turned Y, roll about the twice turned X (rad; intrinsic Z-Y'-X'').
Quat quat_from_angles(double azimuth, double elevation, double roll);

// From the source's frame (X forward, Y right, Z down) to the world's (X forward, Y left, Z up): a half turn about X on
// both ends, so that an identity stays an identity.
inline Vec3 world_from_source(const Vec3& v) {
  return {v.x, -v.y, -v.z};
}
inline Quat world_from_source(const Quat& q) {
  return Quat(q.w, q.x, -q.y, -q.z);
}

}  // namespace posed::tracker
