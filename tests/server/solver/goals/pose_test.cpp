#include <gtest/gtest.h>

#include "tests/server/solver/goals/derivative_check.h"

namespace posed {
namespace {

TEST(PoseGoal, ValueAndDerivatives) {
  test::check_at_random([](std::mt19937& random, const BodyTree& tree) {
    auto goal = test::goal_at(tree, "tip", PoseSpring{test::random_point(random, 1.0), test::random_turn(random)});
    goal.orientation_weight = 3.0;
    return goal;
  });
}

TEST(PoseGoal, EitherHalfMayBeOff) {
  const auto tree = test::build(test::all_joints());
  auto goal = test::goal_at(*tree, "tip", PoseSpring{{1, 0, 0}, quat_about(kX, 1.0)});
  goal.weight = 0.0;
  test::check_derivatives({tree}, goal, {tree->rest()});
  goal.weight = 10.0, goal.orientation_weight = 0.0;
  test::check_derivatives({tree}, goal, {tree->rest()});
}

}  // namespace
}  // namespace posed
