// Priorities (levels.cpp): lower numbers are met first, strictly.
#include <gtest/gtest.h>

#include "tests/support/spring_bench.h"

namespace posed {
namespace {

using test::SpringBench;

// Where all earlier goals can be met, the later ones move none of them.
TEST(Levels, LaterGoalsLeaveMetOnesAsTheyAre) {
  std::mt19937 random(72);
  for (int n = 0; n < 20; ++n) {
    SpringBench b(test::human());
    b.options.iterations = 2000;
    for (const char* end : {"left_hand", "lower_torso", "left_foot"})
      b.pull(end, b.touch(end) + test::random_point(random, 0.02), 10.0);
    b.pull("right_hand", test::random_point(random, 3.0), 10.0).priority = 1;
    const SpringPose both = b.solve();
    for (std::size_t g = 0; g < 3; ++g) EXPECT_LT(b.error(both, g), 1e-6) << n << " " << g;
    EXPECT_LT(test::worst_limit(b.figures, both.q), 1e-9);
  }
}

TEST(Levels, OrderOfTheListDoesNotMatter) {
  SpringBench b(test::human());
  b.pull("right_hand", {3, 0, 1}, 1000).priority = 5;
  b.pull("left_hand", {0, 3, 1}, 1).priority = -5;
  const SpringPose out = b.solve();
  EXPECT_LT(b.error(out, 1), 1e-6);
}

TEST(Levels, OneSidedGoalsOfAnEarlierLevelHaveRoom) {
  SpringBench b(test::human());
  b.pull("lower_torso", b.touch("lower_torso"), 100).priority = kPinPriority;
  b.add("right_hand", PlaneSpring{{0, 0, 1.2}, kZ, true}).priority = -1;
  b.pull("right_hand", {0.3, -0.4, 1.3});
  EXPECT_LT(b.error(b.solve(), 2), 1e-4);
  b.goals[2].spring = PositionSpring{{0.3, -0.4, 1.0}};
  const SpringPose out = b.solve();
  EXPECT_LT(b.error(out, 1), 1e-6);
  EXPECT_NEAR(b.error(out, 2), 0.2, 1e-4);
}

// Two hinges, stretched to reach the goal; the posture would bend the second.
struct Elbow : SpringBench {
  static FigureDocument figure() {
    FigureDocument d = test::column(3, 1.0, JointType::fixed);
    for (std::size_t i = 1; i < 3; ++i) d.segments[i].joint.type = JointType::hinge, d.segments[i].joint.axes = {kY};
    return d;
  }
  explicit Elbow(int posture_priority) : SpringBench(test::build(figure())) {
    SpringGoal posture;
    posture.spring = PostureSpring{{2}, {1.0}};
    posture.priority = posture_priority;
    posture.weight = 1000.0;
    goals.push_back(posture);
    pull("s2", {1.0, 0, 2.5});
  }
};

TEST(Levels, APostureOfALaterLevelLeavesEarlierGoals) {
  Elbow b(1);
  EXPECT_LT(b.error(b.solve(), 1), 1e-6);
}

TEST(Levels, APostureOfAnEarlierLevelIsLeftByLaterGoals) {
  Elbow b(-1);
  EXPECT_LT(b.error(b.solve(), 0), 1e-6);
}

// What goals of a later level add moves no earlier one by more than a hundredth of a millimetre, though limbs that are
// stretched to their end give way where the first order sees no way to give.
TEST(Levels, LaterGoalsLeaveEarlierOnesAsTheyAre) {
  std::mt19937 random(71);
  for (int n = 0; n < 40; ++n) {
    SpringBench b(test::human());
    for (const char* end : {"left_hand", "lower_torso", "left_foot"})
      b.pull(end, b.touch(end) + test::random_point(random, n % 2 == 0 ? 0.3 : 1.5), 10.0);
    const SpringPose alone = b.solve();
    b.pull("right_hand", test::random_point(random, 3.0), 1000.0).priority = 1;
    b.pull("head", test::random_point(random, 3.0), 0.1).priority = 2;
    const SpringPose both = b.solve();
    for (std::size_t g = 0; g < 3; ++g) EXPECT_LT(b.error(both, g), b.error(alone, g) + 1e-5) << n << " " << g;
    EXPECT_LT(test::worst_limit(b.figures, both.q), 1e-9);
  }
}

TEST(Levels, OrientationsAndRelativeGoalsAreHeldToo) {
  SpringBench b(test::human());
  b.pull("lower_torso", b.touch("lower_torso"), 100);
  b.add("right_hand", OrientationSpring{quat_about(kX, 0.5)});
  auto& relative = b.pull("left_hand", {0.3, 0.2, 0.2});
  relative.base_segment = *b.figures[0]->find_segment("upper_torso");
  const SpringPose alone = b.solve();
  b.pull("right_hand", {1.5, 0.5, 0.5}, 100).priority = 1;
  b.pull("left_hand", {-0.5, 1, 2}, 100).priority = 1;
  const SpringPose both = b.solve();
  for (std::size_t g = 0; g < 3; ++g) EXPECT_LT(b.error(both, g), b.error(alone, g) + 1e-6) << g;
}

// The scene "standing": feet pinned, a mild balance. A hand that is pulled in front of the chest is bent out of the way
// by the arm's limits where it comes from below; raised sidewards it gets there.
struct Standing : SpringBench {
  explicit Standing(const Vec3& hand) : SpringBench(test::human()) {
    BalanceSpring balance;
    balance.margin = 0.02;
    for (const char* foot : {"left_foot", "right_foot"}) {
      add(foot, PoseSpring{touch(foot), quat_identity()}).priority = kPinPriority;
      for (const Vec3& corner : {Vec3(0, 0.04, 0), Vec3(0, -0.04, 0), Vec3(-0.26, 0.04, 0), Vec3(-0.26, -0.04, 0)})
        balance.support.push_back({goals.back().at.segment, goals.back().at.point + corner});
    }
    add("lower_torso", balance, 1.0);
    pull("right_hand", hand);
  }
};

// Under pins no other start was tried: the answer stayed in the first valley, 20 mm off balance.
TEST(Levels, OtherStartsAreTriedUnderPinsToo) {
  std::mt19937 random(74);
  int changed = 0;
  for (int n = 0; n < 30; ++n) {
    Standing b(test::random_point(random, 1.2) + Vec3(0, -0.3, 1.0));
    const double stays = b.cost(b.solve().q);
    b.options.explore = true;
    const SpringPose explored = b.solve();
    for (const std::size_t pin : {0, 1}) EXPECT_LT(b.error(explored, pin), 1e-6) << n;
    EXPECT_LT(test::worst_limit(b.figures, explored.q), 1e-9) << n;
    if (!explored.report.branch_changed) continue;
    ++changed;
    EXPECT_LT(b.cost(explored.q), 0.7 * stays) << n;
  }
  EXPECT_GT(changed, 0);
}

// Stiff pins leave a narrow way: a standing figure that reached for what is out of reach took a thousand steps and
// more, and stood still off balance where they had run out.
TEST(Levels, APinnedFigureReachesFarInFewSteps) {
  int steps = 0, ended = 0;
  for (const double y : {-1.1, -1.2, -1.3, -1.5, -2.0}) {
    Standing b({0.0, y, 1.4});
    const SpringPose out = b.solve();
    for (const std::size_t pin : {0, 1}) EXPECT_LT(b.error(out, pin), 1e-6) << y;
    steps += out.report.iterations;
    ended += out.report.status == SolveStatus::converged;
  }
  EXPECT_EQ(ended, 5);
  EXPECT_LT(steps, 5 * 400);
}

// Strictly by priority: a start that serves the first level worse does not win by the second.
TEST(Levels, AnotherStartWinsByTheFirstLevelThatItChanges) {
  std::mt19937 random(73);
  int changed = 0;
  for (int n = 0; n < 60; ++n) {
    SpringBench b(test::human());
    b.start = {test::random_q(random, *b.figures[0])};
    for (const int priority : {0, 0, 0, 1, 1, 2}) {
      b.goals.push_back(test::random_goal(random, b.figures, 0, 1.2));
      b.goals.back().priority = priority;
    }
    const SpringPose stays = b.solve();
    b.options.explore = true;
    const SpringPose explored = b.solve();
    if (!explored.report.branch_changed) {
      EXPECT_TRUE(test::same_bytes(stays.q, explored.q)) << n;
      continue;
    }
    ++changed;
    bool decided = false;
    for (const int level : {0, 1, 2}) {
      double before = 0.0, after = 0.0;
      for (const SpringGoal& goal : b.goals) {
        if (goal.priority != level) continue;
        before += test::cost_of(b.figures, std::span(&goal, 1), stays.q);
        after += test::cost_of(b.figures, std::span(&goal, 1), explored.q);
      }
      if (decided) continue;
      EXPECT_LT(after, before + 1e-3 * before + 1e-7) << n << " level " << level;
      decided = after < 0.7 * before;
    }
    EXPECT_TRUE(decided) << n;
  }
  EXPECT_GT(changed, 0);
}

TEST(Levels, AColdSolveSearchesForAllOfThem) {
  int reached = 0;
  for (const double z : {1.1, 1.15, 1.2, 1.3}) {
    Standing b({0.0, -0.035, z});
    b.options.cold = true;
    const SpringPose out = b.solve();
    for (const std::size_t pin : {0, 1}) EXPECT_LT(b.error(out, pin), 1e-6);
    reached += b.cost(out.q) < 1e-8;
  }
  EXPECT_EQ(reached, 4);
}

}  // namespace
}  // namespace posed
