#include <gtest/gtest.h>

#include "tests/server/solver/goals/derivative_check.h"

namespace posed {
namespace {

TEST(PositionGoal, ValueAndDerivatives) {
  test::check_at_random([](std::mt19937& random, const BodyTree& tree) {
    return test::goal_at(tree, "tip", PositionSpring{test::random_point(random, 1.0)});
  });
}

TEST(PositionGoal, OfEverySegment) {
  const auto tree = test::build(test::all_joints());
  std::mt19937 random(1);
  for (const Segment& s : tree->document().segments) {
    SCOPED_TRACE(s.name);
    test::check_derivatives({tree}, test::goal_at(*tree, s.name.c_str(), PositionSpring{{1, 1, 1}}),
                            {test::random_q(random, *tree)});
  }
}

TEST(PositionGoal, UnderEveryRoot) {
  std::mt19937 random(2);
  for (const JointType root : {JointType::free, JointType::ball, JointType::universal, JointType::hinge,
                               JointType::prismatic, JointType::fixed}) {
    SCOPED_TRACE(static_cast<int>(root));
    const auto tree = test::build(test::all_joints(root));
    test::check_derivatives({tree}, test::goal_at(*tree, "tip", PositionSpring{{1, 1, 1}}),
                            {test::random_q(random, *tree)});
  }
}

}  // namespace
}  // namespace posed
