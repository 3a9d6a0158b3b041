// Bytes of a LIBERTY-family tracker in binary mode -> Frames, answers and error replies. Pure: no I/O, no clock.
// What comes out depends on the bytes alone, never on how they were cut into reads (t_ns apart).
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
#include "server/tracker/frame_assembler.h"
#include "server/tracker/liberty_layout.h"

namespace posed::tracker {

inline constexpr double kMetresPerInch = 0.0254;
inline constexpr double kMetresPerCentimetre = 0.01;

struct LibertyFormat {
  std::string device = "liberty";          // Frame::device
  std::array<char, 2> tag{'L', 'Y'};       // PA: PATRIOT, LU: LATUS, MM: MinuteMan, PL: PATRIOT WIRELESS
  int stations = 16;                       // the highest station there can be
  std::vector<int> items{8, 9, 11, 3, 7};  // the output list; the factory's is 2,4,1
  double metres_per_unit = kMetresPerCentimetre;
  int rate_hz = 240;  // of the frame count
};

// What the device says besides data: the answer to a query (error 0) or a complaint (error as the manual numbers it,
// body its text).
struct LibertyReply {
  int station = 0;  // 0: of none
  std::uint8_t command = 0;
  std::uint8_t error = 0;
  std::vector<std::uint8_t> body;
};

struct LibertyOutput {
  std::vector<Frame> frames;
  std::vector<LibertyReply> replies;
};

class LibertyDecoder {
 public:
  static Result<LibertyDecoder> make(LibertyFormat format);  // Error: as LibertyLayout::make

  // `now`: when the bytes arrived, daemon clock.
  LibertyOutput feed(std::span<const std::uint8_t> bytes, Nanoseconds now);

  void expect_up_to(int station) {
    assembler_.expect_up_to(station);
  }                   // the highest active one, as the device lists them
  void lost_bytes();  // the line lost some here: what is in hand is no record any more
  void restart();     // the stream starts anew: also forgets the frame in hand and the device's clock
  std::uint64_t bad_bytes() const { return bad_bytes_; }  // skipped on the way back into step

 private:
  enum class Kind { nothing, partial, data, reply };
  LibertyDecoder(LibertyFormat format, LibertyLayout layout);
  Kind examine(std::span<const std::uint8_t> bytes, Sample& sample) const;
  void take(Sample sample, std::uint8_t error, Nanoseconds now, LibertyOutput& out);
  Nanoseconds device_time(std::uint32_t count);

  LibertyFormat format_;
  LibertyLayout layout_;
  FrameAssembler assembler_;
  std::vector<std::uint8_t> buffer_;  // the start of a record that has not come whole yet
  bool in_step_ = true;               // the last record ended where the next one must start
  std::uint64_t bad_bytes_ = 0;
  bool have_count_ = false;
  std::uint32_t last_count_ = 0;
  std::int64_t long_count_ = 0;  // the frame count without its wrap at 2^32
};

}  // namespace posed::tracker
