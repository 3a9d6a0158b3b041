// Bytes of a tracker -> Frames and Replies. Pure: no I/O, no clock. What comes out depends on the bytes alone, never on
// how they were cut into reads (t_ns apart), so that a recording of the bytes gives the same Frames again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/frame.h"

namespace posed::tracker {

// What a device says besides data: the answer to a query (error 0) or a complaint (error as its manual numbers it).
struct Reply {
  int station = 0;            // 0: of none
  std::uint32_t command = 0;  // as the family has it: a letter, a control code, a number
  int error = 0;
  std::vector<std::uint8_t> body;
};

struct Heard {
  std::vector<Frame> frames;
  std::vector<Reply> replies;
};

class Decoder {
 public:
  virtual ~Decoder() = default;
  virtual Heard feed(std::span<const std::uint8_t> bytes, Nanoseconds now) = 0;  // `now`: when they arrived
  virtual void expect_up_to(int station) = 0;   // the highest active one, as the device lists them; 0: not known
  virtual void lost_bytes() = 0;                // the line lost some here: what is in hand is no record any more
  virtual std::uint64_t bad_bytes() const = 0;  // skipped on the way back into step
  // Its family and settings in a line of words, from which make_decoder (capture/decoders.h) makes its like.
  virtual std::string description() const = 0;
};

}  // namespace posed::tracker
