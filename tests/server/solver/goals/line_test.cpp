#include <gtest/gtest.h>

#include "tests/server/solver/goals/derivative_check.h"

namespace posed {
namespace {

TEST(LineGoal, ValueAndDerivatives) {
  test::check_at_random([](std::mt19937& random, const BodyTree& tree) {
    return test::goal_at(tree, "tip", LineSpring{test::random_point(random, 1.0), test::random_way(random)});
  });
}

TEST(LineGoal, AlongEveryAxis) {
  const auto tree = test::lone_segment();
  for (const Vec3& way : {kX, kY, kZ, -kX, -kY, -kZ}) {
    test::check_derivatives({tree}, test::goal_at(*tree, "only", LineSpring{{0.1, 0.2, 0.3}, way}), {tree->rest()});
  }
}

}  // namespace
}  // namespace posed
