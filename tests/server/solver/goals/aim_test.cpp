#include <gtest/gtest.h>

#include "tests/server/solver/goals/derivative_check.h"

namespace posed {
namespace {

TEST(AimGoal, AtAPoint) {
  test::check_at_random([](std::mt19937& random, const BodyTree& tree) {
    return test::goal_at(tree, "tip", AimSpring{test::random_way(random), true, test::random_point(random, 2.0)});
  });
}

TEST(AimGoal, AlongADirection) {
  test::check_at_random([](std::mt19937& random, const BodyTree& tree) {
    return test::goal_at(tree, "tip", AimSpring{test::random_way(random), false, test::random_way(random)});
  });
}

TEST(AimGoal, ExactlyOppositeIsHalfATurnAway) {
  const auto tree = test::lone_segment();
  for (const Vec3& axis : {kX, kY, kZ, glm::normalize(Vec3(1, 2, 3))}) {
    const auto along = test::goal_at(*tree, "only", AimSpring{axis, false, -axis});
    EXPECT_NEAR(test::solver_error({tree}, along, {tree->rest()}), 0.25 * M_PI, 1e-9) << axis.x;
    const auto at = test::goal_at(*tree, "only", AimSpring{axis, true, -2.0 * axis});
    EXPECT_NEAR(test::solver_error({tree}, at, {tree->rest()}), 0.25 * M_PI, 1e-9) << axis.x;
  }
}

TEST(AimGoal, AtItsOwnTouchPointIsFinite) {
  const auto tree = test::lone_segment();
  const auto goal = test::goal_at(*tree, "only", AimSpring{kX, true, kZero});
  EXPECT_TRUE(finite(test::solver_error({tree}, goal, {tree->rest()})));
}

}  // namespace
}  // namespace posed
