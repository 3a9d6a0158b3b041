#include "server/calibration/apply.h"

#include <gtest/gtest.h>

#include "server/calibration/measure.h"

namespace posed::calibration {
namespace {

Calibration calibration() {
  Calibration c;
  c.world_from_source = {{1, 0, 0}, quat_about(kZ, M_PI / 2)};
  c.sensors["2"].tip = TipOffset{{0.1, 0, 0}, 0.0, 0};
  c.sensors["2"].boresight = quat_about(kX, 0.5);
  return c;
}

TEST(Apply, TheSourceStandsSomewhereInTheWorld) {
  Frame frame;
  frame.samples.push_back({});
  frame.samples[0].position = {0, 0, 1};
  frame.samples[0].rotation = quat_about(kX, 0.2);
  apply(calibration(), frame);
  EXPECT_LT(glm::length(frame.samples[0].position - Vec3(1, 0, 1)), 1e-12);
  EXPECT_LT(glm::length(frame.samples[0].rotation - quat_about(kZ, M_PI / 2) * quat_about(kX, 0.2)), 1e-12);
}

TEST(Apply, TheTipIsInTheSensorsFrameAndTheBoresightTurnsItLast) {
  const Transform sensor{{0, 0, 1}, quat_about(kZ, M_PI / 2)};
  const Transform tip = world_from_tip(calibration(), 2, sensor);
  // The sensor's X is the source's Y, which is the world's -X.
  EXPECT_LT(glm::length(tip.position - Vec3(0.9, 0, 1)), 1e-12);
  EXPECT_LT(glm::length(tip.rotation - quat_about(kZ, M_PI) * quat_about(kX, 0.5)), 1e-12);
}

TEST(Average, TheMeanTurnHasNoMindForSigns) {
  const std::vector<Transform> poses{{{0, 0, 0}, quat_about(kZ, 0.1)}, {{0.002, 0, 0}, -quat_about(kZ, 0.3)}};
  const Still still = average(poses);
  EXPECT_LT(glm::length(still.mean.position - Vec3(0.001, 0, 0)), 1e-15);
  EXPECT_LT(glm::length(still.mean.rotation - quat_about(kZ, 0.2)), 1e-9);
  EXPECT_NEAR(still.spread_m, 0.001, 1e-12);
}

}  // namespace
}  // namespace posed::calibration
