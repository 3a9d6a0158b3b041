// The paper's scenes with limits off balance the same under both methods: the reach tree's (paper) and springs'.
#include <gtest/gtest.h>

#include "server/solver/springs/spring_solver.h"
#include "tests/support/scene_file.h"
#include "tests/support/unlimited.h"

namespace posed {
namespace {

const char* const kScenes[] = {"paper/single-reach", "paper/two-reaches", "paper/unreachable", "paper/sitting",
                               "paper/restrained",   "paper/seat-belt",   "paper/two-hands",   "paper/straighten"};

struct Both {
  test::SceneFile scene;
  Pose reach;
  SpringPose springs;

  explicit Both(const std::string& name) : scene(test::without_limits(test::read_template(POSED_SOURCE_DIR, name))) {
    auto q = scene.start;
    ReachTreeSolver(scene.tree).solve(q, scene.goals, {}, {}, reach);
    springs.q = {scene.start};
    SpringSolver(scene.tree).solve(test::as_springs(scene.goals), {}, {}, springs);
  }
};

// |sum of weight x displacement| as a share of its terms; no share of less than a micrometre a goal.
double imbalance(const std::vector<GoalReport>& goals, const std::vector<ReachGoal>& asked) {
  Vec3 sum = kZero;
  double terms = 0.0;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    sum += goals[i].force;
    terms += std::max(glm::length(goals[i].force), asked[i].weight * 1e-6);
  }
  return terms > 0.0 ? glm::length(sum) / terms : 0.0;
}

class BothMethods : public testing::TestWithParam<const char*> {};

TEST_P(BothMethods, BalanceTheSame) {
  const Both both(GetParam());
  EXPECT_LT(imbalance(both.reach.goals, both.scene.goals), 1e-6);
  EXPECT_LT(imbalance(both.springs.goals, both.scene.goals), 1e-5);
  EXPECT_LE(both.springs.report.cost, both.reach.report.cost * (1.0 + 1e-6) + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Each, BothMethods, testing::ValuesIn(kScenes));

TEST(BothMethods, TwoGoalsShareTheSameRatio) {
  for (const char* scene : {"paper/unreachable", "paper/restrained"}) {
    const Both both(scene);
    const auto ratio = [](const std::vector<GoalReport>& goals) { return goals[0].error / goals[1].error; };
    ASSERT_EQ(both.springs.goals.size(), 2u) << scene;
    EXPECT_NEAR(ratio(both.springs.goals) / ratio(both.reach.goals), 1.0, 1e-2) << scene;
  }
}

}  // namespace
}  // namespace posed
