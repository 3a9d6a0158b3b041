#include <gtest/gtest.h>

#include "tests/server/solver/goals/derivative_check.h"

namespace posed {
namespace {

using Compare = DistanceSpring::Compare;

void check(Compare compare, double length) {
  test::check_at_random([&](std::mt19937& random, const BodyTree& tree) {
    return test::goal_at(
        tree, "tip",
        DistanceSpring{{tree.find_segment("boxed").value(), test::random_point(random, 0.5)}, length, compare});
  });
}

TEST(DistanceGoal, Equal) {
  check(Compare::equal, 0.5);
}

TEST(DistanceGoal, AtLeast) {
  check(Compare::at_least, 0.2);
  check(Compare::at_least, 3.0);
}

TEST(DistanceGoal, AtMost) {
  check(Compare::at_most, 0.2);
  check(Compare::at_most, 3.0);
}

TEST(DistanceGoal, BothEndsAtOnePlacePullApart) {
  const auto tree = test::build(test::column(2, 0.5));
  SpringGoal goal = test::goal_at(*tree, "s0", DistanceSpring{{1, kZero}, 0.3});
  EXPECT_NEAR(test::solver_error({tree}, goal, {tree->rest()}), 0.3, 1e-12);
}

}  // namespace
}  // namespace posed
