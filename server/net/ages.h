// How old frames were, counted by size: quantiles to about a tenth, in no more time than one addition.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>

#include "common/time.h"

namespace posed::net {

// Each power of two of nanoseconds has eight steps.
struct AgeCounts {
  static constexpr std::size_t kSteps = 8, kSize = 40 * kSteps;
  std::array<std::uint64_t, kSize> counts{};

  static std::size_t step_of(Nanoseconds age) {
    const std::uint64_t a = age < 8 ? 8 : static_cast<std::uint64_t>(age);
    const auto power = static_cast<std::size_t>(std::bit_width(a)) - 4;  // so that a >> power is 8 to 15
    const std::size_t step = power * kSteps + static_cast<std::size_t>(a >> power) - kSteps;
    return step < kSize ? step : kSize - 1;
  }

  std::uint64_t total() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t count : counts) sum += count;
    return sum;
  }
  // What came since `before`, which was read from the same counts.
  AgeCounts since(const AgeCounts& before) const {
    AgeCounts difference;
    for (std::size_t i = 0; i < kSize; ++i) difference.counts[i] = counts[i] - before.counts[i];
    return difference;
  }
  // The middle of the step in which it lies; 0 without any.
  double quantile_us(double p) const {
    const double wanted = p * static_cast<double>(total());
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < kSize; ++i) {
      sum += counts[i];
      if (sum > 0 && static_cast<double>(sum) >= wanted) {
        const double low = static_cast<double>((kSteps + i % kSteps) << (i / kSteps));
        return 1e-3 * low * (1.0 + 0.5 / static_cast<double>(kSteps + i % kSteps));
      }
    }
    return 0.0;
  }
};

// Written by the network thread, read by any.
class AgeMeter {
 public:
  void add(Nanoseconds age) {
    auto& count = counts_[AgeCounts::step_of(age)];
    count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  AgeCounts read() const {
    AgeCounts now;
    for (std::size_t i = 0; i < counts_.size(); ++i) now.counts[i] = counts_[i].load(std::memory_order_relaxed);
    return now;
  }

 private:
  std::array<std::atomic<std::uint64_t>, AgeCounts::kSize> counts_{};
};

}  // namespace posed::net
