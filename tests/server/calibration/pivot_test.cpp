#include "server/calibration/pivot.h"

#include <gtest/gtest.h>

#include <random>

namespace posed::calibration {
namespace {

const Vec3 kTip{0.152, -0.003, 0.021};
const Vec3 kPivot{0.4, -0.25, 0.9};

// The stylus swung about its tip in a circle of `swing` rad, turned about itself too where `twists`.
std::vector<Transform> swung(double swing, bool twists, double noise = 0.0) {
  std::mt19937 random(7);
  std::normal_distribution<double> off(0.0, noise);
  std::vector<Transform> poses;
  for (int i = 0; i < 480; ++i) {
    const double a = 2.0 * M_PI * i / 240.0;
    const Vec3 axis(std::cos(a), std::sin(a), 0.0);
    const Quat turn = quat_about(axis, swing) * quat_about(kX, twists ? 0.8 * std::sin(0.31 * a) : 0.0);
    poses.push_back({kPivot - turn * kTip + Vec3(off(random), off(random), off(random)), turn});
  }
  return poses;
}

TEST(Pivot, FindsTheTip) {
  const auto tip = fit_pivot(swung(0.5, true));
  ASSERT_TRUE(tip) << tip.error().message;
  EXPECT_LT(glm::length(tip->offset - kTip), 1e-9);
  EXPECT_LT(tip->residual_m, 1e-9);
  EXPECT_EQ(tip->samples, 480);
}

TEST(Pivot, NoiseAveragesOutAndIsTold) {
  const auto tip = fit_pivot(swung(0.5, true, 0.001));
  ASSERT_TRUE(tip);
  EXPECT_LT(glm::length(tip->offset - kTip), 5e-4);
  // Three axes of a millimetre each.
  EXPECT_NEAR(tip->residual_m, 0.001 * std::sqrt(3.0), 2e-4);
}

TEST(Pivot, TooLittleMotionIsRefused) {
  EXPECT_FALSE(fit_pivot({}));
  EXPECT_FALSE(fit_pivot(swung(0.5, true).empty() ? std::vector<Transform>{} : std::vector<Transform>(5)));
  EXPECT_FALSE(fit_pivot(swung(0.001, false)));
  // About one axis only: anywhere along it the tip could be.
  std::vector<Transform> hinge;
  for (int i = 0; i < 100; ++i) {
    const Quat turn = quat_about(kZ, 0.02 * i);
    hinge.push_back({kPivot - turn * kTip, turn});
  }
  const auto refused = fit_pivot(hinge);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "invalid_params");
  EXPECT_FALSE(refused.error().hint.empty());
}

}  // namespace
}  // namespace posed::calibration
