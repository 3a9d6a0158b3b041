// What the cases share.
#pragma once

#include <algorithm>
#include <vector>

#include "common/time.h"

namespace posed::test {

inline constexpr Nanoseconds kSecond = 1'000'000'000, kMillisecond = 1'000'000;
inline constexpr int kRounds = 9;

inline double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace posed::test
