// Time is integer nanoseconds. On the daemon's clock they count from its start (monotonic); device clocks have their
// own zero.
#pragma once

#include <chrono>
#include <cstdint>

namespace posed {

using Nanoseconds = std::int64_t;

// The daemon's clock. Read at the edges only (where bytes arrive or leave); inside, time is carried as a value.
class Clock {
 public:
  Clock() : start_(std::chrono::steady_clock::now()) {}
  Nanoseconds now() const {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_;
};

inline Nanoseconds utc_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace posed
