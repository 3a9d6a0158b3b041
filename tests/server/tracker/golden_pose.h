// The pose of all trackers' golden files, as it is in the world's axes: Y and Z turned round.
#pragma once

#include <gtest/gtest.h>

#include "common/frame.h"

namespace posed::test {

inline void expect_golden_pose(const Sample& sample, double tolerance) {
  EXPECT_NEAR(sample.position.x, 0.254, tolerance);
  EXPECT_NEAR(sample.position.y, 0.0635, tolerance);
  EXPECT_NEAR(sample.position.z, -0.08255, tolerance);
  EXPECT_NEAR(sample.rotation.w, 0.871836437, tolerance);
  EXPECT_NEAR(sample.rotation.x, 0.214679867, tolerance);
  EXPECT_NEAR(sample.rotation.y, 0.188823735, tolerance);
  EXPECT_NEAR(sample.rotation.z, -0.397692569, tolerance);
}

}  // namespace posed::test
