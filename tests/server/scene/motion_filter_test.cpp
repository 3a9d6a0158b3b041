#include "server/scene/motion_filter.h"

#include <gtest/gtest.h>

#include <random>

namespace posed {
namespace {

constexpr Nanoseconds kPeriod = 1'000'000'000 / 240;
const BindingFilter kCalm{OneEuro{1.0, 2.0, 1.0}, 0.0};

double angle_between(const Quat& a, const Quat& b) {
  return 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

TEST(MotionFilter, ASensorThatStandsStillTremblesLess) {
  std::mt19937 random(1);
  std::normal_distribution<double> off(0.0, 1e-3);
  MotionFilter filter;
  double raw_sum = 0.0, sum = 0.0, raw_turn = 0.0, turn = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 axis = glm::normalize(Vec3(off(random), off(random), off(random)));
    const Transform raw{{off(random), off(random), off(random)}, quat_about(axis, off(random))};
    const Transform out = filter.next(kCalm, raw, i * kPeriod);
    if (i < 500) continue;
    raw_sum += glm::dot(raw.position, raw.position);
    sum += glm::dot(out.position, out.position);
    raw_turn += angle_between(raw.rotation, quat_identity());
    turn += angle_between(out.rotation, quat_identity());
  }
  EXPECT_LT(sum, 0.05 * raw_sum);
  EXPECT_LT(turn, 0.3 * raw_turn);
}

// What the paper is about: the lag of a fast motion shrinks with beta.
TEST(MotionFilter, FastMotionLagsLittleWithBeta) {
  const auto lag = [](double beta) {
    MotionFilter filter;
    Transform out;
    for (int i = 0; i < 480; ++i) {
      const double t = i / 240.0;
      out = filter.next({OneEuro{1.0, beta, 1.0}, 0.0}, {{t, 0, 0}, quat_about(kZ, t)}, i * kPeriod);
    }
    const double there = 479.0 / 240.0;
    return std::pair(there - out.position.x, angle_between(out.rotation, quat_about(kZ, there)));
  };
  EXPECT_GT(lag(0.0).first, 0.1) << "a low pass of 1 Hz lags by 160 ms";
  EXPECT_LT(lag(10.0).first, 0.02);
  EXPECT_GT(lag(0.0).second, 0.1);
  EXPECT_LT(lag(10.0).second, 0.02);
}

// The formulas of the paper, by hand for one step.
TEST(MotionFilter, OneStepIsAsThePaperHasIt) {
  MotionFilter filter;
  filter.next(kCalm, {{0, 0, 0}, quat_identity()}, 0);
  const double dt = 1e-9 * static_cast<double>(kPeriod);
  const auto alpha = [dt](double cutoff) { return 1.0 / (1.0 + 1.0 / (2.0 * M_PI * cutoff) / dt); };
  const double dx = alpha(1.0) * (0.01 / dt);
  const double x = alpha(1.0 + 2.0 * dx) * 0.01;
  EXPECT_NEAR(filter.next(kCalm, {{0.01, 0, 0}, quat_identity()}, kPeriod).position.x, x, 1e-12);
}

TEST(MotionFilter, AGapBeginsAnew) {
  MotionFilter filter;
  for (int i = 0; i < 100; ++i) filter.next(kCalm, {}, i * kPeriod);
  const Transform far{{5, 5, 5}, quat_about(kX, 2.0)};
  const Nanoseconds last = 99 * kPeriod;
  EXPECT_EQ(filter.next(kCalm, far, last + MotionFilter::kGap + 1).position, far.position);
  EXPECT_EQ(filter.next(kCalm, {}, last).position, kZero) << "back in time, as after a restart of the device";
  EXPECT_NE(filter.next(kCalm, far, last + kPeriod).position, far.position);
}

TEST(MotionFilter, TheSameTimeTwiceIsTheSameSample) {
  MotionFilter filter;
  filter.next(kCalm, {}, 0);
  const Transform once = filter.next(kCalm, {{1, 0, 0}, quat_identity()}, kPeriod);
  EXPECT_EQ(filter.next(kCalm, {{2, 0, 0}, quat_identity()}, kPeriod).position, once.position);
}

TEST(MotionFilter, PredictionLooksAheadAndIsBounded) {
  const BindingFilter ahead{{}, 50.0};
  MotionFilter filter;
  Transform out;
  for (int i = 0; i < 480; ++i) {
    const double t = i / 240.0;
    out = filter.next(ahead, {{t, 0, 0}, quat_about(kZ, 2.0 * t)}, i * kPeriod);
  }
  EXPECT_NEAR(out.position.x, 479.0 / 240.0 + 0.05, 1e-6);
  EXPECT_NEAR(angle_between(out.rotation, quat_about(kZ, 2.0 * (479.0 / 240.0 + 0.05))), 0.0, 1e-6);
  // A sensor that jumps ten metres between two frames is not thrown another 100 m.
  out = filter.next(ahead, {{12, 0, 0}, quat_about(kZ, 2.0)}, 480 * kPeriod);
  EXPECT_LE(glm::length(out.position - Vec3(12, 0, 0)), MotionFilter::kMostAhead + 1e-12);
  EXPECT_LE(angle_between(out.rotation, quat_about(kZ, 2.0)), MotionFilter::kMostTurnAhead + 1e-9);
}

}  // namespace
}  // namespace posed
