// When a sample was measured, on the daemon's clock: from the device's own count, which ticks evenly, and not from the
// bytes' arrival, which waits in buffers. The least delayed arrivals anchor the count; a slow correction follows the
// drift between the two clocks. Pure; no allocation.
#pragma once

#include <cstdint>

#include "common/time.h"

namespace posed::tracker {

class HostClock {
 public:
  struct Stats {
    double jitter_us = 0.0;  // root mean square of what arrivals were later than measured, about its mean
    double lag_us = 0.0;     // the most that one was later
    int samples = 0;
  };

  // `device_t_ns`: the device's own time of it; `arrived`: on the daemon's clock. Never later than `arrived`. Begins
  // anew where the device's time goes back or leaves the daemon's by more than kGap.
  Nanoseconds measured(Nanoseconds device_t_ns, Nanoseconds arrived);
  Stats take();  // since the last call

  static constexpr Nanoseconds kGap = 1'000'000'000;

 private:
  bool begun_ = false;
  Nanoseconds last_device_ = 0, last_arrived_ = 0;
  Nanoseconds offset_ = 0;  // daemon's clock less the device's, at the least delayed arrivals
  double sum_us_ = 0.0, squares_ = 0.0, most_us_ = 0.0;
  int samples_ = 0;
};

}  // namespace posed::tracker
