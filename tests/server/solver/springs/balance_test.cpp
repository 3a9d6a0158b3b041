// The answer is a balance: no joint can follow the way down (spring_judge.h computes that apart from the solver).
#include <gtest/gtest.h>

#include "tests/support/spring_bench.h"

namespace posed {
namespace {

using test::SpringBench;

TEST(Balance, OfTwoGoalsOutOfReach) {
  for (const double weight : {1.0, 10.0, 100.0}) {
    SpringBench b(test::human());
    b.pull("lower_torso", {0, 0, 0.9275}, 100);
    b.pull("right_hand", {1.5, -0.5, 1.6}, weight);
    const SpringPose out = b.solve();
    EXPECT_EQ(out.report.status, SolveStatus::converged);
    EXPECT_LT(b.unbalance(out), 2e-5) << weight;
    EXPECT_LT(test::worst_limit(b.figures, out.q), 1e-9);
  }
}

// Two men hand to hand: each goal is a spring between them.
TEST(Balance, FiguresJoinedByARelativeGoalMeetHalfWay) {
  SpringBench b(test::Figures{test::human(), test::human()});
  b.options.iterations = 20'000;
  b.start[1][0] += 3.0;
  const auto place = [&](int f) {
    return Vec3(b.start[static_cast<std::size_t>(f)][0], b.start[static_cast<std::size_t>(f)][1],
                b.start[static_cast<std::size_t>(f)][2]);
  };
  const Vec3 first = place(0), second = place(1);
  const int hand = *b.figures[0]->find_segment("left_hand");
  auto& held = b.add("right_hand", PositionSpring{b.figures[1]->segment(hand).touch_point}, 10.0, 0);
  held.base_segment = hand, held.base_figure = 1;
  b.add("lower_torso", PositionSpring{first}, 10.0, 0).at.point = kZero;
  b.add("lower_torso", PositionSpring{second}, 10.0, 1).at.point = kZero;
  const SpringPose out = b.solve();
  const Vec3 moved = out.world_from_segment[0][0].position - first,
             back = out.world_from_segment[1][0].position - second;
  EXPECT_GT(b.error(out, 0), 0.1);
  EXPECT_GT(moved.x, 0.1);
  EXPECT_LT(glm::length(moved + back), 1e-4);  // action and reaction
  EXPECT_NEAR(b.error(out, 0), b.error(out, 1), 1e-4);
  EXPECT_LT(b.unbalance(out), 2e-5);
}

TEST(Balance, ARelativeGoalWithinOneFigureLeavesTheRootAlone) {
  SpringBench b(test::human());
  auto& goal = b.pull("right_hand", {0.2, -0.1, 0.1});
  goal.base_segment = *b.figures[0]->find_segment("head");
  const SpringPose out = b.solve();
  EXPECT_LT(b.error(out, 0), 1e-5);
  EXPECT_LT(glm::length(out.world_from_segment[0][0].position - b.touch("lower_torso")), 0.3);
}

TEST(Balance, ADirtySolverAnswersAsAFreshOne) {
  std::mt19937 random(95);
  SpringBench used(test::build(test::all_joints()));
  for (int n = 0; n < 20; ++n) {
    used.goals = {test::random_goal(random, used.figures, n % test::kKinds, 1.0),
                  test::random_goal(random, used.figures, (n + 3) % test::kKinds, 1.0)};
    used.start = {test::random_q(random, *used.figures[0])};
    SpringBench fresh(used.figures);
    fresh.goals = used.goals, fresh.start = used.start;
    EXPECT_TRUE(test::same_bytes(used.solve().q, fresh.solve().q)) << n;
  }
}

struct Tally {
  int all = 0, converged = 0;
};

void expect_balanced(SpringBench& b, Tally& tally, int n) {
  const SpringPose out = b.solve();
  ++tally.all;
  EXPECT_LT(test::worst_limit(b.figures, out.q), 1e-9) << n;
  if (out.report.status != SolveStatus::converged) return;
  ++tally.converged;
  EXPECT_LT(b.unbalance(out), 2e-5) << n << " cost " << b.cost(out.q);
}

void expect_most(const Tally& tally, int percent = 95) {
  EXPECT_GE(tally.converged, tally.all * percent / 100) << tally.all;
}

TEST(Balance, OfAHumanPulledAtSeveralPlaces) {
  std::mt19937 random(96);
  Tally tally;
  for (int n = 0; n < 40; ++n) {
    SpringBench b(test::human());
    for (int k = 0; k < 5; ++k) {
      b.goals.push_back(test::random_goal(random, b.figures, 0, 1.5));
      b.goals.back().base_segment = -1;
    }
    expect_balanced(b, tally, n);
  }
  expect_most(tally);
}

TEST(Balance, OfEachKindOfGoalAlone) {
  std::mt19937 random(91);
  for (int kind = 0; kind < test::kKinds; ++kind) {
    SCOPED_TRACE(kind);
    Tally tally;
    for (int n = 0; n < 12; ++n) {
      SpringBench b(test::build(test::all_joints(n % 2 == 0 ? JointType::free : JointType::fixed)));
      b.goals = {test::random_goal(random, b.figures, kind, 1.5)};
      b.start = {test::random_q(random, *b.figures[0])};
      expect_balanced(b, tally, n);
    }
    expect_most(tally);
  }
}

// Turns, planes and lines relative to another segment have no terms of second order, so that some mixes out of reach
// run out of iterations. They say so.
TEST(Balance, OfAHumanWithGoalsOfAllKinds) {
  std::mt19937 random(92);
  Tally tally;
  for (int n = 0; n < 60; ++n) {
    SpringBench b(test::human());
    for (int k = 2 + test::pick(random, 6); k > 0; --k)
      b.goals.push_back(test::random_goal(random, b.figures, test::pick(random, test::kKinds), 1.5));
    expect_balanced(b, tally, n);
  }
  expect_most(tally, 80);
}

// Balls came to rest where the later one has them.
TEST(Balance, OfTwoPosturesOfEachJoint) {
  std::mt19937 random(97);
  const auto tree = test::build(test::all_joints());
  for (int joint = 0; joint < tree->size(); ++joint) {
    SpringBench b(tree);
    for (const double weight : {10.0, 4.0}) {
      const auto q = test::random_q(random, *tree);
      const auto first = q.begin() + tree->q_at(joint);
      SpringGoal goal;
      goal.spring = PostureSpring{{joint}, {first, first + q_size(tree->joint(joint).type)}};
      goal.weight = weight;
      b.goals.push_back(goal);
    }
    const SpringPose out = b.solve();
    EXPECT_EQ(out.report.status, SolveStatus::converged) << tree->segment(joint).name;
    EXPECT_LT(b.unbalance(out), 2e-5) << tree->segment(joint).name;
    for (std::size_t g = 0; g < 2; ++g) EXPECT_NEAR(b.error(out, g), out.goals[g].error, 1e-9);
  }
}

TEST(Balance, OfRandomFiguresOfAllJoints) {
  std::mt19937 random(93);
  Tally tally;
  for (int n = 0; n < 120; ++n) {
    SpringBench b(test::build(test::random_limited_figure(random, 10)));
    for (int k = 1 + test::pick(random, 5); k > 0; --k)
      b.goals.push_back(test::random_goal(random, b.figures, test::pick(random, test::kKinds), 1.0));
    b.start = {test::random_q(random, *b.figures[0])};
    expect_balanced(b, tally, n);
  }
  expect_most(tally, 90);
}

TEST(Balance, OfFiguresTiedTogether) {
  std::mt19937 random(94);
  Tally tally;
  for (int n = 0; n < 30; ++n) {
    SpringBench b(test::Figures{test::human(), test::build(test::quadruped())});
    b.start[1][0] = 1.0;
    for (int k = 0; k < 6; ++k)
      b.goals.push_back(test::random_goal(random, b.figures, k == 0 ? 6 : test::pick(random, 7), 1.5));
    expect_balanced(b, tally, n);
  }
  expect_most(tally, 90);
}

}  // namespace
}  // namespace posed
