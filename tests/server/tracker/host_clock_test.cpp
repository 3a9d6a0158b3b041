#include "server/tracker/host_clock.h"

#include <gtest/gtest.h>

#include <random>

namespace posed::tracker {
namespace {

constexpr Nanoseconds kMs = 1'000'000, kPeriod = 1'000'000'000 / 240;

TEST(HostClock, BufferedArrivalsDoNotMoveTheTimeOfTheSample) {
  HostClock clock;
  std::mt19937 random(3);
  std::uniform_int_distribution<Nanoseconds> delay(0, 5 * kMs);
  Nanoseconds last = 0;
  for (int i = 0; i < 2400; ++i) {
    const Nanoseconds device = i * kPeriod, truth = 70'000 * kMs + device;
    // Four of them arrive at once.
    const Nanoseconds arrived = 70'000 * kMs + (i / 4 * 4 + 3) * kPeriod + delay(random);
    const Nanoseconds measured = clock.measured(device, arrived);
    EXPECT_LE(measured, arrived);
    if (i > 240) {
      EXPECT_NEAR(static_cast<double>(measured - last), static_cast<double>(kPeriod), 0.5 * kMs) << i;
      EXPECT_NEAR(static_cast<double>(measured - truth), 0.0, 0.5 * kMs) << i;
    }
    last = measured;
  }
  const HostClock::Stats stats = clock.take();
  EXPECT_EQ(stats.samples, 2400);
  EXPECT_GT(stats.jitter_us, 3000.0);
  EXPECT_LT(stats.jitter_us, 8000.0);
  EXPECT_GT(stats.lag_us, 12'000.0);
  EXPECT_LT(stats.lag_us, 18'000.0);
  EXPECT_EQ(clock.take().samples, 0);
}

// A crystal that is slow or fast by a tenth of a thousandth: after ten minutes that would be 60 ms.
TEST(HostClock, DriftIsFollowed) {
  for (const double drift : {-1e-4, 1e-4}) {
    HostClock clock;
    for (int i = 0; i < 600 * 240; i += 8) {
      const Nanoseconds truth = i * kPeriod;
      const auto device = static_cast<Nanoseconds>(static_cast<double>(truth) * (1.0 + drift));
      const Nanoseconds measured = clock.measured(device, truth + kMs);
      EXPECT_NEAR(static_cast<double>(measured - truth), 1.0 * kMs, 0.1 * kMs) << drift << ' ' << i;
    }
  }
}

TEST(HostClock, ADeviceThatBeginsAnewIsNotCarriedOn) {
  HostClock clock;
  clock.measured(500'000 * kMs, 1000 * kMs);
  EXPECT_EQ(clock.measured(0, 1010 * kMs), 1010 * kMs);
  EXPECT_EQ(clock.measured(90'000 * kMs, 1020 * kMs), 1020 * kMs) << "a leap of the count alone";
}

}  // namespace
}  // namespace posed::tracker
