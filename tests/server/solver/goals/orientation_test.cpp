#include <gtest/gtest.h>

#include "tests/server/solver/goals/derivative_check.h"

namespace posed {
namespace {

TEST(OrientationGoal, ValueAndDerivatives) {
  test::check_at_random([](std::mt19937& random, const BodyTree& tree) {
    return test::goal_at(tree, "tip", OrientationSpring{test::random_turn(random)});
  });
}

TEST(OrientationGoal, CloseToWhatIsWanted) {
  const auto tree = test::lone_segment();
  for (const double angle : {1e-3, 1e-4, 1e-6, 0.0}) {
    SCOPED_TRACE(angle);
    const auto goal = test::goal_at(*tree, "only", OrientationSpring{quat_about(kY, angle)});
    test::check_derivatives({tree}, goal, {tree->rest()});
  }
}

// The logarithm jumps there, so it is its value and a way out that count.
TEST(OrientationGoal, HalfATurnAway) {
  const auto tree = test::lone_segment();
  for (const Vec3& axis : {kX, kY, kZ, glm::normalize(Vec3(1, 2, 3)), glm::normalize(Vec3(-1, 1, 0))}) {
    for (const double angle : {M_PI, M_PI - 1e-9, M_PI - 1e-6, -M_PI}) {
      const auto goal = test::goal_at(*tree, "only", OrientationSpring{quat_about(axis, angle)});
      EXPECT_NEAR(test::solver_error({tree}, goal, {tree->rest()}), 0.25 * std::abs(angle), 1e-9) << axis.x << angle;
    }
  }
}

}  // namespace
}  // namespace posed
