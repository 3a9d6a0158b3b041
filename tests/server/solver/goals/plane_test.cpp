#include <gtest/gtest.h>

#include "tests/server/solver/goals/derivative_check.h"

namespace posed {
namespace {

TEST(PlaneGoal, On) {
  test::check_at_random([](std::mt19937& random, const BodyTree& tree) {
    return test::goal_at(tree, "tip", PlaneSpring{test::random_point(random, 1.0), test::random_way(random), false});
  });
}

TEST(PlaneGoal, AboveCountsOneSideOnly) {
  test::check_at_random([](std::mt19937& random, const BodyTree& tree) {
    return test::goal_at(tree, "tip", PlaneSpring{test::random_point(random, 1.0), test::random_way(random), true});
  });
  const auto tree = test::lone_segment();
  const auto error = [&](double height) {
    return test::solver_error({tree}, test::goal_at(*tree, "only", PlaneSpring{{0, 0, height}, kZ, true}),
                              {tree->rest()});
  };
  EXPECT_EQ(error(-0.2), 0.0);
  EXPECT_NEAR(error(0.2), 0.2, 1e-15);
}

}  // namespace
}  // namespace posed
