// A device's own time from its frame count, which does not jitter as its stamps and the arrival do. The count wraps at
// 2^32. Pure.
#pragma once

#include <cstdint>

#include "common/time.h"

namespace posed::tracker {

class DeviceClock {
 public:
  explicit DeviceClock(int rate_hz) : rate_hz_(rate_hz) {}

  Nanoseconds at(std::uint32_t count) {
    long_count_ = have_count_ ? long_count_ + static_cast<std::int32_t>(count - last_count_) : count;
    have_count_ = true;
    last_count_ = count;
    constexpr std::int64_t kSecond = 1'000'000'000;
    return long_count_ / rate_hz_ * kSecond + long_count_ % rate_hz_ * kSecond / rate_hz_;
  }

 private:
  int rate_hz_;
  bool have_count_ = false;
  std::uint32_t last_count_ = 0;
  std::int64_t long_count_ = 0;  // without the wrap
};

}  // namespace posed::tracker
