#include <gtest/gtest.h>

#include "tests/server/solver/goals/derivative_check.h"

namespace posed {
namespace {

SpringGoal posture(std::mt19937& random, const BodyTree& tree, std::vector<int> joints) {
  PostureSpring spring;
  const auto q = test::random_q(random, tree);
  for (const int j : joints) {
    spring.joints.push_back(j);
    for (int k = 0; k < q_size(tree.joint(j).type); ++k)
      spring.values.push_back(q[static_cast<std::size_t>(tree.q_at(j) + k)]);
  }
  SpringGoal goal;
  goal.spring = std::move(spring);
  return goal;
}

TEST(PostureGoal, OfEachJoint) {
  std::mt19937 random(3);
  const auto tree = test::build(test::all_joints());
  for (int j = 0; j < tree->size(); ++j) {
    for (int n = 0; n < 10; ++n) {
      SCOPED_TRACE(tree->segment(j).name);
      const auto goal = posture(random, *tree, {j});
      test::check_derivatives({tree}, goal, {test::random_q(random, *tree)});
    }
  }
}

TEST(PostureGoal, OfAllJoints) {
  test::check_alone_at_random([](std::mt19937& random, const BodyTree& tree) {
    return posture(random, tree, {0, 1, 2, 3, 4, 5, 6, 7, 8});
  });
}

}  // namespace
}  // namespace posed
