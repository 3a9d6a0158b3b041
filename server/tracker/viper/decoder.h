// Bytes of a VIPER -> Frames and replies. One of its pose frames is one instant of all sensors.
// Source: the SDK's protocol headers as the public drivers have them. Distortion is a level without a documented scale,
// and virtual sensors have no station of their own: both are left out.
#pragma once

#include <map>
#include <string>

#include "server/tracker/decoder.h"
#include "server/tracker/device_clock.h"
#include "server/tracker/record_buffer.h"

namespace posed::tracker {

struct ViperFormat {
  std::string device = "viper";  // Frame::device
  int rate_hz = 240;             // of the frame count
};

class ViperDecoder final : public Decoder {
 public:
  explicit ViperDecoder(ViperFormat format);

  Heard feed(std::span<const std::uint8_t> bytes, Nanoseconds now) override;
  void expect_up_to(int) override {}  // a pose frame says how many it holds
  void lost_bytes() override { buffer_.lost_bytes(); }
  std::uint64_t bad_bytes() const override { return buffer_.bad_bytes(); }
  std::string description() const override;

 private:
  // False where no device could have sent it, whatever its CRC.
  bool take_pose(std::span<const std::uint8_t> frame, Nanoseconds now, Heard& out);

  ViperFormat format_;
  RecordBuffer buffer_;
  DeviceClock clock_;
  std::map<int, Quat> last_rotation_;
};

}  // namespace posed::tracker
