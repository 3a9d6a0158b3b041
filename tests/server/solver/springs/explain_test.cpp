// States and causes of goals (PUBLIC-SURFACE: Goals).
#include "server/solver/springs/explain.h"

#include <gtest/gtest.h>

#include "tests/support/spring_bench.h"

namespace posed {
namespace {

using test::SpringBench;

bool names_goal(const GoalReport& report, int goal) {
  for (const Cause& c : report.causes) {
    if (c.kind == Cause::Kind::goal && c.goal == goal) return true;
  }
  return false;
}

const Cause* limit_of(const GoalReport& report, int joint) {
  for (const Cause& c : report.causes) {
    if (c.kind == Cause::Kind::limit && c.joint == joint) return &c;
  }
  return nullptr;
}

TEST(Explain, AReachedGoalHasNoCauses) {
  SpringBench b(test::human());
  b.pull("right_hand", {0.4, -0.3, 1.2});
  const SpringPose out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::reached);
  EXPECT_TRUE(out.goals[0].causes.empty());
}

TEST(Explain, ToleranceCountsAsReached) {
  SpringBench b(test::human());
  b.pull("lower_torso", {0, 0, 0.9275}, 1e4);
  b.pull("right_hand", {1.0, -0.3, 1.3}).tolerance = 2.0;
  EXPECT_EQ(b.solve().goals[1].state, GoalState::reached);
}

// The chain ends 0.3 m before the target, along the base's own -y.
TEST(Explain, ABoxOfToleranceHasTheBasesAxes) {
  SpringBench b(test::build(test::column(4, 0.5, JointType::fixed)));
  SpringGoal& goal = b.pull("s3", {0, -1.8, 0.5});
  goal.world_from_base.rotation = quat_about(kZ, M_PI / 2);
  goal.tolerance = GoalTolerance(Vec3(0.01, 0.31, 0.01));
  EXPECT_EQ(b.solve().goals[0].state, GoalState::reached);
  goal.tolerance = GoalTolerance(Vec3(0.31, 0.29, 0.31));
  EXPECT_EQ(b.solve().goals[0].state, GoalState::unreachable);
}

TEST(Explain, BeyondAFixedRootIsUnreachable) {
  SpringBench b(test::build(test::column(4, 0.5, JointType::fixed)));
  b.pull("s3", {5, 0, 0.5});
  const SpringPose out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::unreachable);
  EXPECT_NEAR(out.goals[0].error, 3.5, 1e-6);
}

// 0.12 m beyond the straight chain: PUBLIC-SURFACE's {"beyond_m":0.12}.
TEST(Explain, UnreachableSaysHowFarBeyond) {
  SpringBench b(test::build(test::column(4, 0.5, JointType::fixed)));
  b.pull("s3", {1.62, 0, 0.5});
  const SpringPose out = b.solve();
  ASSERT_EQ(out.goals[0].causes.size(), 1u);
  EXPECT_EQ(out.goals[0].causes[0].kind, Cause::Kind::beyond);
  EXPECT_NEAR(out.goals[0].causes[0].beyond_m, 0.12, 1e-6);
}

// Two links on a table edge: the hinge stops at its range.
struct Stopped : SpringBench {
  static FigureDocument figure() {
    FigureDocument d = test::column(2, 1.0, JointType::fixed);
    d.segments[1].joint.type = JointType::hinge;
    d.segments[1].joint.axes = {kY};
    d.segments[1].joint.limits = {Limit{-0.7, 1.0}};
    return d;
  }
  Stopped() : SpringBench(test::build(figure())) {}
};

// No joint that is free of its limit can bring it nearer: that is unreachable, and the limit is the cause.
TEST(Explain, ALimitIsNamedWithItsSide) {
  Stopped b;
  for (const double side : {1.0, -1.0}) {
    b.goals.clear();
    b.pull("s1", {0.5 * side, 0, 0});
    const SpringPose out = b.solve();
    EXPECT_EQ(out.goals[0].state, GoalState::unreachable);
    ASSERT_TRUE(limit_of(out.goals[0], 1));
    EXPECT_EQ(limit_of(out.goals[0], 1)->side, side > 0.0 ? Cause::Side::max : Cause::Side::min);
  }
}

// The hinge at its limit holds more of the pull than the goal that opposes it at the next hinge.
TEST(Explain, MostlyHeldByALimitIsLimited) {
  FigureDocument d = test::column(3, 1.0, JointType::fixed);
  for (std::size_t i = 1; i < 3; ++i) {
    d.segments[i].joint.type = JointType::hinge;
    d.segments[i].joint.axes = {kY};
  }
  d.segments[1].joint.limits = {Limit{-0.1, 0.1}};
  SpringBench b(test::build(d));
  b.pull("s2", {6, 0, 1}, 10);
  b.pull("s2", {-1, 0, 3}, 10);
  const SpringPose out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::limited);
  ASSERT_TRUE(limit_of(out.goals[0], 1));
  EXPECT_EQ(limit_of(out.goals[0], 1)->side, Cause::Side::max);
  EXPECT_TRUE(names_goal(out.goals[0], 1));
  EXPECT_EQ(limit_of(out.goals[1], 1), nullptr);
}

TEST(Explain, TheSwingIsNamed) {
  FigureDocument d = test::column(2, 1.0, JointType::fixed);
  d.segments[1].joint.swing = test::ellipse(0.5, 0.5);
  SpringBench b(test::build(d));
  b.pull("s1", {1, 0, 1});
  const SpringPose out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::unreachable);
  ASSERT_TRUE(limit_of(out.goals[0], 1));
  EXPECT_EQ(limit_of(out.goals[0], 1)->side, Cause::Side::swing);
}

TEST(Explain, BalancedGoalsNameEachOther) {
  SpringBench b(test::human());
  b.pull("left_hand", {-2, 0, 1}, 40);
  b.pull("right_hand", {2, 0, 1}, 10);
  const SpringPose out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::balanced);
  EXPECT_EQ(out.goals[1].state, GoalState::balanced);
  EXPECT_TRUE(names_goal(out.goals[0], 1));
  EXPECT_TRUE(names_goal(out.goals[1], 0));
  EXPECT_LT(glm::length(out.goals[0].force + out.goals[1].force), 1e-3 * glm::length(out.goals[0].force));
}

TEST(Explain, WeakGoalsAreBalancedTheSame) {
  SpringBench b(test::human());
  b.pull("left_hand", {-2, 0, 1}, 4e-4);
  b.pull("right_hand", {2, 0, 1}, 1e-4);
  const SpringPose out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::balanced);
  EXPECT_EQ(out.goals[1].state, GoalState::balanced);
}

TEST(Explain, AFigureOfMillimetresIsBalancedTheSame) {
  SpringBench b(test::build(test::column(4, 1e-3, JointType::free)));
  b.pull("s0", {-1, 0, 0}, 10);
  b.pull("s3", {1, 0, 0}, 10);
  const SpringPose out = b.solve();
  EXPECT_EQ(out.goals[1].state, GoalState::balanced);
}

TEST(Explain, APinIsNamed) {
  SpringBench b(test::human());
  b.add("lower_torso", PoseSpring{b.touch("lower_torso"), quat_identity()}, 100).priority = kPinPriority;
  b.pull("right_hand", {3, 0, 1});
  const SpringPose out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::reached);
  EXPECT_NE(out.goals[1].state, GoalState::reached);
  EXPECT_TRUE(names_goal(out.goals[1], 0));
}

// A hundredth of a radian, on whatever lever.
TEST(Explain, TurnsAreReachedWithinAHundredthOfARadian) {
  FigureDocument d = test::column(2, 0.5, JointType::fixed);
  d.segments[1].joint.type = JointType::hinge;
  d.segments[1].joint.axes = {kY};
  d.segments[1].joint.limits = {Limit{0.0, 0.0}};
  for (const double lever : {0.25, 2.0}) {
    d.lever = lever;
    SpringBench b(test::build(d));
    for (const double off : {0.009, 0.011}) {
      const GoalState state = off < 0.01 ? GoalState::reached : GoalState::unreachable;
      const auto v = quat_about(kY, off);
      b.goals.clear();
      b.add("s1", OrientationSpring{v});
      EXPECT_EQ(b.solve().goals[0].state, state) << "orientation " << off << " lever " << lever;
      b.goals.clear();
      b.add("s1", AimSpring{kZ, false, v * kZ});
      EXPECT_EQ(b.solve().goals[0].state, state) << "aim " << off << " lever " << lever;
      b.goals.clear();
      SpringGoal posture;
      posture.spring = PostureSpring{{1}, {off}};
      b.goals.push_back(posture);
      EXPECT_EQ(b.solve().goals[0].state, state) << "posture " << off << " lever " << lever;
    }
  }
}

TEST(Explain, ErrorsAndCostAreThoseOfTheJudge) {
  std::mt19937 random(81);
  for (int n = 0; n < 60; ++n) {
    SpringBench b(n % 2 == 0 ? test::human() : test::build(test::all_joints()));
    for (int k = 0; k < 5; ++k)
      b.goals.push_back(test::random_goal(random, b.figures, (n + 2 * k) % test::kKinds, 1.5));
    std::size_t postures = 0;
    for (const SpringGoal& g : b.goals) postures += std::holds_alternative<PostureSpring>(g.spring);
    if (postures > 1) continue;
    b.start = {test::random_q(random, *b.figures[0])};
    const SpringPose out = b.solve();
    for (std::size_t g = 0; g < b.goals.size(); ++g)
      EXPECT_NEAR(out.goals[g].error, b.error(out, g), 1e-7) << n << " kind " << b.goals[g].spring.index();
    EXPECT_NEAR(out.report.cost, b.cost(out.q), 1e-6 * std::max(1.0, out.report.cost)) << n;
  }
}

TEST(Explain, ForceIsWeightTimesError) {
  std::mt19937 random(82);
  for (int kind = 0; kind < 7; ++kind) {  // those with a place to take hold
    if (kind == 2) continue;              // a pose goal has two
    SpringBench b(test::build(test::column(2, 0.5, JointType::fixed)));
    b.goals = {test::random_goal(random, b.figures, kind, 3.0)};
    b.goals[0].at.segment = 1, b.goals[0].base_segment = -1;
    const SpringPose out = b.solve();
    EXPECT_NEAR(glm::length(out.goals[0].force), 10.0 * out.goals[0].error, 1e-9) << kind;
  }
}

// The joint's range is far away; it is the stream's bound that holds it for this frame.
TEST(Explain, TheStreamsBoundIsNoLimitOfTheJoint) {
  Stopped b;
  b.options.most_turn = 0.01;
  b.pull("s1", {0.5, 0, 1.9});
  EXPECT_EQ(limit_of(b.solve().goals[0], 1), nullptr);
}

}  // namespace
}  // namespace posed
