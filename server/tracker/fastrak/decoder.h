// Bytes of a FASTRAK -> Frames and replies. A record is '0', the station as a digit, an error letter or a blank, and
// the items of the output list; the header is the same in binary and in ASCII. No checksum: of
// 300,000 random bodies behind a right header none was taken for a sample (false_frames_test). Source: FASTRAK manual
// OPM00PI002 Rev G, output records; record checks as the public drivers (VRPN) have them.
#pragma once

#include <string>
#include <vector>

#include "common/result.h"
#include "server/tracker/decoder.h"
#include "server/tracker/fastrak/layout.h"
#include "server/tracker/frame_assembler.h"
#include "server/tracker/record_buffer.h"

namespace posed::tracker {

struct FastrakFormat {
  std::string device = "fastrak";        // Frame::device
  int stations = 4;                      // the highest station there can be
  std::vector<int> items{2, 11, 16, 0};  // the output list; the factory's is 2,4,1
  bool binary = true;
  double metres_per_unit = kMetresPerCentimetre;
};

class FastrakDecoder final : public Decoder {
 public:
  static Result<FastrakDecoder> make(FastrakFormat format);  // Error: as FastrakLayout::make

  Heard feed(std::span<const std::uint8_t> bytes, Nanoseconds now) override;
  void expect_up_to(int station) override { assembler_.expect_up_to(station); }
  void lost_bytes() override { buffer_.lost_bytes(); }
  std::uint64_t bad_bytes() const override { return buffer_.bad_bytes(); }
  std::string description() const override;

 private:
  FastrakDecoder(FastrakFormat format, FastrakLayout layout);
  std::size_t examine_data(std::span<const std::uint8_t> bytes, bool in_step, Nanoseconds now, Heard& out);
  bool begins_record(std::span<const std::uint8_t> bytes) const;  // as far as they go

  FastrakFormat format_;
  FastrakLayout layout_;
  FrameAssembler assembler_;
  RecordBuffer buffer_;
};

}  // namespace posed::tracker
