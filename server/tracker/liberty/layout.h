// The body of a LIBERTY data record: items in the order of the output list (command O).
// Source: LIBERTY User Manual URM03PH156 Rev H, table 2-19 (binary sizes).
// Pure; throws nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/frame.h"
#include "common/result.h"
#include "server/tracker/axes.h"

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

}  // namespace posed::tracker
