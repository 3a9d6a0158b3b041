// Bytes of a 3SPACE ISOTRAK II in binary mode, output list 2,11 -> Frames and replies. A record is 17 bytes (the header
// as a FASTRAK's, seven 16-bit numbers) packed into 20 of seven bits: each group of up to seven is followed by their
// eighth bits. Only the first byte has its own eighth bit set, so that a record's start cannot be mistaken. No
// checksum: of random bodies behind a right header 0.6 % are taken, those whose quaternion happens to have about the
// right length; of 8 MB of noise none (false_frames_test). Source: the
// packing, the scales and the button's letters as VRPN's driver has them from the ISOTRAK II manual.
#pragma once

#include <string>

#include "server/tracker/decoder.h"
#include "server/tracker/frame_assembler.h"
#include "server/tracker/record_buffer.h"

namespace posed::tracker {

struct IsotrakFormat {
  std::string device = "isotrak";  // Frame::device
  int stations = 2;                // the highest station there can be
};

class IsotrakDecoder final : public Decoder {
 public:
  explicit IsotrakDecoder(IsotrakFormat format);

  Heard feed(std::span<const std::uint8_t> bytes, Nanoseconds now) override;
  void expect_up_to(int station) override { assembler_.expect_up_to(station); }
  void lost_bytes() override { buffer_.lost_bytes(); }
  std::uint64_t bad_bytes() const override { return buffer_.bad_bytes(); }
  std::string description() const override;

 private:
  std::size_t examine_data(std::span<const std::uint8_t> bytes, Nanoseconds now, Heard& out);

  IsotrakFormat format_;
  FrameAssembler assembler_;
  RecordBuffer buffer_;
};

}  // namespace posed::tracker
