// Bytes of a LIBERTY-family tracker in binary mode -> Frames, answers and error replies.
// No checksum: of 300,000 random bodies behind a right header none was taken for a sample, nor any of 8 MB of noise
// (false_frames_test); the quaternion's length and the distortion's level give them away.
// Source: LIBERTY User Manual URM03PH156 Rev H, binary frame header, tables 2-19 and 2-46, error codes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/frame.h"
#include "common/result.h"
#include "server/tracker/axes.h"
#include "server/tracker/decoder.h"
#include "server/tracker/device_clock.h"
#include "server/tracker/frame_assembler.h"
#include "server/tracker/liberty/layout.h"
#include "server/tracker/record_buffer.h"

namespace posed::tracker {

struct LibertyFormat {
  std::string device = "liberty";          // Frame::device
  std::array<char, 2> tag{'L', 'Y'};       // PA: PATRIOT, LU: LATUS, MM: MinuteMan, PL: PATRIOT WIRELESS
  int stations = 16;                       // the highest station there can be
  std::vector<int> items{8, 9, 11, 3, 7};  // the output list; the factory's is 2,4,1
  double metres_per_unit = kMetresPerCentimetre;
  int rate_hz = 240;  // of the frame count
};

class LibertyDecoder final : public Decoder {
 public:
  static Result<LibertyDecoder> make(LibertyFormat format);  // Error: as LibertyLayout::make

  Heard feed(std::span<const std::uint8_t> bytes, Nanoseconds now) override;
  void expect_up_to(int station) override { assembler_.expect_up_to(station); }
  void lost_bytes() override { buffer_.lost_bytes(); }
  std::uint64_t bad_bytes() const override { return buffer_.bad_bytes(); }
  std::string description() const override;

 private:
  enum class Kind { nothing, partial, data, reply };
  LibertyDecoder(LibertyFormat format, LibertyLayout layout);
  Kind examine(std::span<const std::uint8_t> bytes, bool in_step, Sample& sample) const;
  void take(Sample sample, std::uint8_t error, Nanoseconds now, Heard& out);

  LibertyFormat format_;
  LibertyLayout layout_;
  FrameAssembler assembler_;
  RecordBuffer buffer_;
  DeviceClock clock_;
};

}  // namespace posed::tracker
