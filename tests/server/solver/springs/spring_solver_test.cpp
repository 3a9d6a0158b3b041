#include "server/solver/springs/spring_solver.h"

#include <gtest/gtest.h>

#include "tests/support/allocation_counter.h"
#include "tests/support/spring_bench.h"

namespace posed {
namespace {

using test::SpringBench;

TEST(SpringSolver, AHandWithinItsArmsReachLeavesThePelvis) {
  for (const Vec3& target : {Vec3(0.4, -0.3, 1.2), Vec3(0.35, -0.2, 1.4), Vec3(0.1, -0.6, 1.3), Vec3(0.45, -0.2, 1.0),
                             Vec3(0.2, -0.5, 1.6), Vec3(0.3, 0.0, 1.1), Vec3(0.5, -0.25, 1.35)}) {
    SpringBench b(test::human());
    b.pull("right_hand", target);
    const SpringPose out = b.solve();
    EXPECT_EQ(out.goals[0].state, GoalState::reached);
    EXPECT_LT(b.error(out, 0), 1e-6);
    const Vec3 pelvis(out.q[0][0], out.q[0][1], out.q[0][2]), before(b.start[0][0], b.start[0][1], b.start[0][2]);
    EXPECT_LT(glm::length(pelvis - before), 0.01) << target.x << " " << target.y << " " << target.z;
    EXPECT_LT(test::worst_limit(b.figures, out.q), 1e-9);
  }
}

TEST(SpringSolver, DistancesGoAsTheWeights) {
  SpringBench b(test::human());
  b.pull("lower_torso", {0, 0, 0.9275}, 40);
  b.pull("right_hand", {3, 0, 1}, 10);
  const SpringPose out = b.solve();
  EXPECT_EQ(out.report.status, SolveStatus::converged);
  EXPECT_NEAR(b.error(out, 1) / b.error(out, 0), 4.0, 1e-4);
  EXPECT_EQ(out.goals[1].state, GoalState::balanced);
  bool named = false;
  for (const Cause& c : out.goals[1].causes) named = named || (c.kind == Cause::Kind::goal && c.goal == 0);
  EXPECT_TRUE(named);
}

TEST(SpringSolver, OffGoalsDoNothing) {
  SpringBench b(test::human());
  b.pull("right_hand", {2, 1, 1}, 0);
  b.pull("left_hand", {2, 1, 1}).enabled = false;
  const SpringPose out = b.solve();
  EXPECT_TRUE(test::same_bytes(out.q, b.start));
  for (const GoalReport& g : out.goals) EXPECT_EQ(g.state, GoalState::off);
  EXPECT_EQ(out.report.status, SolveStatus::converged);
}

TEST(SpringSolver, AStartOutsideTheLimitsIsTakenInside) {
  std::mt19937 random(61);
  for (int n = 0; n < 100; ++n) {
    SpringBench b(test::human());
    for (double& v : b.start[0]) v = test::uniform(random, -1.0, 1.0);
    normalise_quaternions(*b.figures[0], b.start[0]);
    for (const char* end : {"left_hand", "right_hand", "left_foot", "right_foot", "head"})
      b.pull(end, test::random_point(random, 1.0));
    EXPECT_LT(test::worst_limit(b.figures, b.solve().q), 1e-9) << n;
  }
}

TEST(SpringSolver, StopsWhenAskedWithASoundPose) {
  for (const bool cold : {false, true}) {
    for (int after = 0; after < 12; ++after) {
      SpringBench b(test::human());
      b.options.cold = cold;
      b.options.explore = !cold;
      for (const char* end : {"left_hand", "right_hand", "left_foot", "right_foot", "head"})
        b.pull(end, {3, 0.1 * after, 1});
      int asked = 0;
      const SpringPose out = b.solve([&] { return ++asked > after; });
      EXPECT_EQ(out.report.status, SolveStatus::deadline) << cold << after;
      EXPECT_LE(out.report.iterations, after + 3);
      EXPECT_LT(test::worst_limit(b.figures, out.q), 1e-9);
      EXPECT_LT(test::worst_bone(*b.figures[0], out.world_from_segment[0]), 1e-9);
      EXPECT_LE(b.cost(out.q), b.cost(b.start) * (1.0 + 1e-3));  // straight limbs have been bent a little
      EXPECT_NEAR(out.report.cost, b.cost(out.q), 1e-9 * out.report.cost);
    }
  }
}

std::vector<SpringGoal> of_every_kind(SpringBench& b) {
  b.pull("right_hand", {0.5, -0.3, 1.2});
  b.add("head", OrientationSpring{quat_about(kZ, 0.3)});
  b.add("left_foot", PoseSpring{b.touch("left_foot"), quat_identity()}, 100.0);
  b.add("neck", AimSpring{kX, true, {2, 1, 1}});
  b.add("left_hand", PlaneSpring{{0, 0.4, 0}, kY, true});
  b.add("left_lower_arm", LineSpring{{0, 0.3, 1}, kZ});
  b.add("left_hand", DistanceSpring{{*b.figures[0]->find_segment("right_hand"), kZero}, 0.5});
  SpringGoal balance;
  balance.spring = BalanceSpring{{{*b.figures[0]->find_segment("left_foot"), {0, 0, 0}},
                                  {*b.figures[0]->find_segment("left_foot"), {0.2, 0, 0}},
                                  {*b.figures[0]->find_segment("right_foot"), {0.2, 0, 0}}},
                                 0.01};
  b.goals.push_back(balance);
  SpringGoal posture;
  const int waist = *b.figures[0]->find_joint("waist");
  posture.spring = PostureSpring{{waist}, {0, 0, 0, 1}};
  b.goals.push_back(posture);
  b.pull("right_lower_arm", {0, -0.1, 0}).base_segment = *b.figures[0]->find_segment("upper_torso");
  return b.goals;
}

TEST(SpringSolver, DoesNotAllocateOnceWarm) {
  SpringBench b(test::human());
  of_every_kind(b);
  b.goals[0].priority = -1;
  const std::function<bool()> never = [] { return false; };
  SpringPose out;
  out.q = b.start;
  for (const bool cold : {false, true}) {
    b.options.cold = cold;
    b.options.explore = !cold;
    b.solver.solve(b.goals, b.options, never, out);
    const std::size_t before = test::allocation_count();
    for (int n = 0; n < 20; ++n) {
      std::get<PositionSpring>(b.goals[0].spring).position.x = 0.05 * n;
      b.solver.solve(b.goals, b.options, never, out);
    }
    EXPECT_EQ(test::allocation_count(), before) << cold;
  }
}

TEST(SpringSolver, SameInputSameBytes) {
  std::mt19937 random(62);
  SpringBench used(test::human());
  for (int n = 0; n < 30; ++n) {
    used.goals.clear();
    for (int k = 0; k < 6; ++k)
      used.goals.push_back(test::random_goal(random, used.figures, (n + k) % test::kKinds, 1.5));
    for (SpringGoal& g : used.goals) g.priority = n % 3 == 0 ? test::pick(random, 2) : 0;
    used.options.cold = n % 2 == 0;
    used.options.explore = n % 4 == 1;
    used.start = {test::random_q(random, *used.figures[0])};
    const SpringPose a = used.solve(), again = used.solve();
    EXPECT_TRUE(test::same_bytes(a.q, again.q)) << n;
    SpringBench fresh(used.figures);
    fresh.goals = used.goals, fresh.options = used.options, fresh.start = used.start;
    EXPECT_TRUE(test::same_bytes(a.q, fresh.solve().q)) << n;
  }
}

TEST(SpringSolver, KeepsQuaternionsUnitAndTheirSigns) {
  SpringBench b(test::human());
  const auto elbow = static_cast<std::size_t>(b.figures[0]->q_at(*b.figures[0]->find_joint("right_elbow")));
  b.start[0][elbow + 3] = -1.0;
  b.pull("lower_torso", {0, 0, 0.9275}, 100);
  b.pull("right_hand", kZero);
  for (int n = 0; n <= 200; ++n) {
    const double angle = 4.0 * M_PI * n / 200.0;
    b.goals[1].spring = PositionSpring{{0.3 + 0.2 * std::cos(angle), -0.3, 1.2 + 0.3 * std::sin(angle)}};
    const SpringPose out = b.solve();
    EXPECT_LT(test::worst_quaternion(*b.figures[0], out.q[0]), 1e-12);
    each_quaternion(*b.figures[0], [&](std::size_t first) {
      const std::span<const double> was(b.start[0]), is(out.q[0]);
      EXPECT_GE(glm::dot(quat_from_xyzw(was.subspan(first, 4)), quat_from_xyzw(is.subspan(first, 4))), 0.0);
    });
    b.start = out.q;
  }
}

TEST(SpringSolver, PinnedRootsDoNotMove) {
  SpringBench b(test::human());
  const Vec3 place(b.start[0][0], b.start[0][1], b.start[0][2]);
  SpringGoal pin = test::goal_at(*b.figures[0], "lower_torso", PoseSpring{place, quat_about(kZ, 0.5)}, 1000.0);
  pin.at.point = kZero;
  pin.priority = kPinPriority;
  b.goals = {pin};
  b.pull("right_hand", {5, 0, 1}, 1e5);
  const SpringPose out = b.solve();
  EXPECT_LT(glm::length(out.world_from_segment[0][0].position - place), 1e-9);
  EXPECT_LT(glm::length(out.world_from_segment[0][0].rotation * kX - quat_about(kZ, 0.5) * kX), 1e-9);
  EXPECT_EQ(out.report.status, SolveStatus::converged);
}

TEST(SpringSolver, PinsHoldAgainstAnyWeight) {
  SpringBench b(test::human());
  for (const char* foot : {"left_foot", "right_foot"}) b.pull(foot, b.touch(foot), 10.0).priority = kPinPriority;
  b.pull("right_hand", {4, 0, 3}, 1e4);
  const SpringPose out = b.solve();
  EXPECT_LT(b.error(out, 0), 1e-6);
  EXPECT_LT(b.error(out, 1), 1e-6);
  EXPECT_EQ(out.goals[2].state, GoalState::balanced);
}

// Goals that pull at nothing (all weights zero) and joints that no goal moves are answered for, too.
TEST(SpringSolver, JointsThatNoGoalMovesComeInsideTheirLimitsToo) {
  SpringBench b(test::human());
  const auto knee = static_cast<std::size_t>(b.figures[0]->q_at(*b.figures[0]->find_joint("left_knee")));
  const auto v = xyzw(quat_about(kY, -1.0));  // bent the wrong way
  std::copy(v.begin(), v.end(), b.start[0].begin() + static_cast<std::ptrdiff_t>(knee));
  ASSERT_GT(test::worst_limit(b.figures, b.start), 0.5);
  EXPECT_LT(test::worst_limit(b.figures, b.solve().q), 1e-9) << "no goals";
  b.pull("right_hand", {0.4, -0.3, 1.2});
  EXPECT_LT(test::worst_limit(b.figures, b.solve().q), 1e-9) << "a goal elsewhere";
}

TEST(SpringSolver, PreparingTakesTheAllocationsWithIt) {
  SpringBench warm(test::human()), fresh(test::human());
  of_every_kind(warm);
  SpringPose out;
  out.q = warm.start;
  warm.solver.solve(warm.goals, warm.options, {}, out);  // `out` has its memory
  fresh.solver.prepare(warm.goals);
  const std::size_t before = test::allocation_count();
  fresh.solver.solve(warm.goals, warm.options, {}, out);
  EXPECT_EQ(test::allocation_count(), before);
}

// Points of support are as much a part of the goal as its margin.
TEST(SpringSolver, ANewPlaceOfSupportIsSeen) {
  SpringBench b(test::human());
  b.pull("left_foot", b.touch("left_foot"), 100);
  SpringGoal goal;
  const int foot = *b.figures[0]->find_segment("left_foot");
  goal.spring = BalanceSpring{{{foot, {0, 0, 0}}, {foot, {0.1, 0, 0}}}, 0.0};
  b.goals.push_back(goal);
  b.solve();
  std::get<BalanceSpring>(b.goals[1].spring).support = {{foot, {0, 0.5, 0}}, {foot, {0.1, 0.5, 0}}};
  SpringBench fresh(b.figures);
  fresh.goals = b.goals;
  EXPECT_TRUE(test::same_bytes(b.solve().q, fresh.solve().q));
}

}  // namespace
}  // namespace posed
