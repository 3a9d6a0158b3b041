// An open line to a device: bytes written out, chunks read in. USB, a serial line and hidraw all look like this, so
// that no session knows which of them carries it. One thread, the driver's.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>
#include <vector>

#include "common/time.h"

namespace posed::tracker {

struct Chunk {
  std::vector<std::uint8_t> bytes;
  Nanoseconds t_ns = 0;  // when they arrived, daemon clock
  bool gap = false;      // some were lost before these
};

class Line {
 public:
  // gone: the device or its cable; error: a transfer failed, as it also does when a device is pulled out. Either way
  // this line is done.
  enum class Trouble { none, gone, error };

  virtual ~Line() = default;                                 // closes
  virtual bool write(std::string_view bytes) = 0;            // at most about a second; false: Trouble
  virtual void wait(std::chrono::milliseconds at_most) = 0;  // for something to take
  virtual std::vector<Chunk> take() = 0;                     // what arrived since the last call
  virtual Trouble trouble() const = 0;
};

}  // namespace posed::tracker
