#include "server/tracker/host_clock.h"

#include <algorithm>
#include <cmath>

namespace posed::tracker {
namespace {

// Crystals differ by less: the offset may grow by this share of the time that passes, so that a device whose clock is
// slow does not seem to be ever later.
constexpr double kMostDrift = 200e-6;

}  // namespace

Nanoseconds HostClock::measured(Nanoseconds device_t_ns, Nanoseconds arrived) {
  const Nanoseconds device_step = device_t_ns - last_device_, step = arrived - last_arrived_;
  const bool leaps = device_step < 0 || std::abs(device_step - step) > kGap;
  if (!begun_ || leaps) {
    begun_ = true;
    offset_ = arrived - device_t_ns;
  } else {
    offset_ += static_cast<Nanoseconds>(kMostDrift * static_cast<double>(step));
    offset_ = std::min(offset_, arrived - device_t_ns);
  }
  last_device_ = device_t_ns;
  last_arrived_ = arrived;
  const Nanoseconds measured = device_t_ns + offset_;
  const double late_us = 1e-3 * static_cast<double>(arrived - measured);
  sum_us_ += late_us;
  squares_ += late_us * late_us;
  most_us_ = std::max(most_us_, late_us);
  ++samples_;
  return measured;
}

HostClock::Stats HostClock::take() {
  Stats stats;
  stats.samples = samples_;
  if (samples_ > 0) {
    const double mean = sum_us_ / samples_;
    stats.jitter_us = std::sqrt(std::max(0.0, squares_ / samples_ - mean * mean));
    stats.lag_us = most_us_;
  }
  sum_us_ = squares_ = most_us_ = 0.0;
  samples_ = 0;
  return stats;
}

}  // namespace posed::tracker
