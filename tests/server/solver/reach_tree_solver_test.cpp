#include "server/solver/reach_tree_solver.h"

#include <gtest/gtest.h>

#include <limits>

#include "server/solver/kinematics.h"
#include "server/solver/tempus.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/figures.h"

namespace posed {
namespace {

using test::column;

struct Bench {
  std::shared_ptr<const BodyTree> tree;
  ReachTreeSolver solver;
  std::vector<double> start, q;
  std::vector<ReachGoal> goals;
  ReachTreeOptions options;

  explicit Bench(std::shared_ptr<const BodyTree> figure) : tree(figure), solver(figure), start(start_pose(*tree)) {}

  void pull(const char* segment, const Vec3& target, double weight) {
    const AttachedPoint held = tree->attach({segment, {}, ""}).value();
    goals.push_back({held.segment, held.point, target, weight, 0.0, true});
  }
  Pose solve() {
    Pose out;
    q = start;
    solver.solve(q, goals, options, {}, out);
    return out;
  }
};

Vec3 total_force(const Pose& pose) {
  Vec3 sum = kZero;
  for (const GoalReport& g : pose.goals) sum += g.force;
  return sum;
}

TEST(ReachTreeSolver, ALoneGoalMovesTheWholeFigureRigidly) {
  Bench b(test::human());
  b.pull("right_hand", {2, 1, 1}, 10);
  const Pose out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::reached);
  EXPECT_NEAR(out.goals[0].error, 0.0, 1e-12);
  for (std::size_t k = 3; k < out.q.size(); ++k) EXPECT_EQ(out.q[k], b.start[k]);
  EXPECT_NE(out.q[0], b.start[0]);
  EXPECT_EQ(out.report.status, SolveStatus::converged);
}

TEST(ReachTreeSolver, AHandWithinItsArmsReachLeavesTheTrunk) {
  Bench b(test::human());
  b.pull("lower_torso", {0, 0, 0.9275}, 100);
  b.pull("right_hand", {0.4, -0.3, 1.3}, 10);
  const Pose out = b.solve();
  EXPECT_LT(out.goals[1].error, 1e-9);
  const int waist = b.tree->q_at(*b.tree->find_joint("waist"));
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(out.q[static_cast<std::size_t>(waist + k)], b.start[static_cast<std::size_t>(waist + k)]);
}

TEST(ReachTreeSolver, DistancesGoAsTheWeights) {
  Bench b(test::human());
  b.pull("lower_torso", {0, 0, 0.9275}, 40);
  b.pull("right_hand", {3, 0, 1}, 10);
  const Pose out = b.solve();
  EXPECT_NEAR(out.goals[1].error / out.goals[0].error, 4.0, 1e-6);
  EXPECT_EQ(out.goals[1].state, GoalState::balanced);
  ASSERT_EQ(out.goals[1].causes.size(), 2u);
  EXPECT_EQ(out.goals[1].causes[0].goal, 0);
  EXPECT_EQ(out.goals[1].causes[1].kind, Cause::Kind::beyond);
  EXPECT_NEAR(out.goals[1].causes[1].beyond_m, out.goals[1].error, 1e-6);
}

TEST(ReachTreeSolver, ARatioOfTenThousandIsSlowAndSaysSo) {
  Bench b(test::build(column(3, 0.5)));
  b.pull("s0", {0, 0, 0.5}, 1);
  b.pull("s2", {0, 0, 4.0}, 10'000);
  b.pull("s1", {0, 3, 0}, 1);
  b.options.root_iterations = 5;
  const Pose early = b.solve();
  EXPECT_EQ(early.report.status, SolveStatus::stalled);
  EXPECT_GT(early.report.balance_error, 1e-6);
  EXPECT_NEAR(early.report.balance_error,
              glm::length(total_force(early)) / (glm::length(early.goals[0].force) + glm::length(early.goals[1].force) +
                                                 glm::length(early.goals[2].force)),
              1e-9);
  b.options.root_iterations = 100'000;
  const Pose late = b.solve();
  EXPECT_LT(late.report.balance_error, early.report.balance_error);
}

TEST(ReachTreeSolver, OffGoalsDoNothing) {
  Bench b(test::human());
  b.pull("right_hand", {2, 1, 1}, 0);
  b.pull("left_hand", {2, 1, 1}, 10);
  b.goals[1].enabled = false;
  b.pull("head", {std::numeric_limits<double>::quiet_NaN(), 0, 0}, 10);
  b.pull("neck", {0, 0, 0}, -1);
  const Pose out = b.solve();
  EXPECT_EQ(out.q, b.start);
  for (const GoalReport& g : out.goals) EXPECT_EQ(g.state, GoalState::off);
  EXPECT_EQ(out.report.status, SolveStatus::converged);
  EXPECT_TRUE(test::all_finite(out));
}

TEST(ReachTreeSolver, WithoutGoalsThePoseStays) {
  Bench b(test::human());
  EXPECT_EQ(b.solve().q, b.start);
}

TEST(ReachTreeSolver, AFixedRootBendsTheChainAndSaysWhatIsOutOfReach) {
  Bench b(test::build(column(4, 0.5, JointType::fixed)));
  b.pull("s3", {0.4, 0.3, 1.5}, 10);
  Pose out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::reached);
  EXPECT_EQ(out.report.status, SolveStatus::converged);

  b.goals[0].target = {5, 0, 0.5};
  out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::unreachable);
  EXPECT_EQ(out.report.status, SolveStatus::converged);
  ASSERT_EQ(out.goals[0].causes.size(), 1u);
  EXPECT_NEAR(out.goals[0].causes[0].beyond_m, 5.0 - 1.5, 1e-9);
  EXPECT_EQ(out.world_from_segment[0].position, kZero);

  b.pull("s0", {1, 0, 0}, 10);
  EXPECT_EQ(b.solve().goals[1].state, GoalState::unreachable);
}

TEST(ReachTreeSolver, RigidJointsAreLinksOfTheChain) {
  FigureDocument d = column(5, 0.5, JointType::fixed);
  d.segments[2].joint.type = JointType::hinge;
  d.segments[2].joint.axes = {kY};
  d.segments[3].joint.type = JointType::prismatic;
  d.segments[3].joint.axes = {kZ};
  Bench b(test::build(d));
  const auto hinge = static_cast<std::size_t>(b.tree->q_at(2));
  b.start[hinge] = 0.7, b.start[hinge + 1] = 0.2;
  b.pull("s4", {1.1, 0.3, 1.3}, 10);
  const Pose out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::reached);
  EXPECT_EQ(out.q[hinge], 0.7);
  EXPECT_EQ(out.q[hinge + 1], 0.2);
}

// Undoing the step that could not be made once read the position of a free root, which such a short q does not hold.
TEST(ReachTreeSolver, AFigureThatCanNotBendIsLeftAsItIs) {
  FigureDocument d = column(2, 0.5, JointType::fixed);
  d.segments[1].joint.type = JointType::hinge;
  d.segments[1].joint.axes = {kY};
  Bench b(test::build(d));
  b.pull("s1", {1, 0, 0}, 10);
  const Pose out = b.solve();
  EXPECT_EQ(out.q, b.start);
  EXPECT_EQ(out.goals[0].state, GoalState::unreachable);
  EXPECT_EQ(out.report.chain_solves, 0);
}

TEST(ReachTreeSolver, SeveralGoalsOfOneSegmentPullAtTheirMean) {
  Bench b(test::human());
  const int hand = *b.tree->find_segment("right_hand");
  b.pull("lower_torso", {0, 0, 0.9275}, 1000);
  b.goals.push_back({hand, {0, -0.1, 0}, {0.4, -0.3, 1.3}, 30, 0, true});
  b.goals.push_back({hand, {0, 0.0, 0}, {0.4, -0.2, 1.3}, 10, 0, true});
  const Pose out = b.solve();
  EXPECT_LT(glm::length(total_force(out)), 1e-6);
  const Vec3 mean = (out.goals[1].touch * 30.0 + out.goals[2].touch * 10.0) / 40.0;
  EXPECT_LT(glm::length(mean - Vec3(0.4, -0.275, 1.3)), 1e-9);
}

TEST(ReachTreeSolver, StopsWhenAskedWithAPose) {
  Bench b(test::human());
  b.pull("right_hand", {3, 0, 1}, 10);
  b.pull("left_hand", {-3, 0, 1}, 20);
  b.pull("lower_torso", {0, 2, 1}, 5);
  int asked = 0;
  Pose out;
  b.q = b.start;
  b.solver.solve(
      b.q, b.goals, {}, [&] { return ++asked > 2; }, out);
  EXPECT_EQ(out.report.status, SolveStatus::deadline);
  EXPECT_EQ(out.report.iterations, 2);
  EXPECT_TRUE(test::all_finite(out));
}

TEST(ReachTreeSolver, DeeplyNestedGoalsEndAtTheLimit) {
  Bench b(test::build(column(500, 0.1)));
  for (int i = 0; i < 500; ++i) b.goals.push_back({i, {0, 0, 0.1}, {0.1 * i, 1, 0}, 10, 0, true});
  b.options.chain_solve_limit = 500;
  const Pose out = b.solve();
  EXPECT_EQ(out.report.status, SolveStatus::stalled);
  EXPECT_LE(out.report.chain_solves, 500);
  EXPECT_TRUE(test::all_finite(out));
  EXPECT_LT(test::worst_bone(*b.tree, out.world_from_segment), 1e-9);
}

TEST(ReachTreeSolver, DoesNotAllocateOnceWarm) {
  Bench b(test::human());
  for (const char* name : {"left_hand", "right_hand", "lower_torso", "left_foot", "right_foot", "head"}) {
    b.pull(name, {0.3, 0.1, 1.2}, 10);
  }
  Pose out;
  b.q = b.start;
  const std::function<bool()> never = [] { return false; };
  b.solver.solve(b.q, b.goals, b.options, never, out);
  const std::size_t before = test::allocation_count();
  std::mt19937 random(3);
  for (int n = 0; n < 200; ++n) {
    b.goals[static_cast<std::size_t>(n % 6)].target = test::random_point(random, 2.0);
    b.solver.solve(b.q, b.goals, b.options, never, out);
  }
  EXPECT_EQ(test::allocation_count(), before);
}

TEST(ReachTreeSolver, PreparingTakesTheAllocationsWithIt) {
  Bench b(test::human());
  b.pull("lower_torso", {0, 0, 1}, 10);
  b.pull("right_hand", {1, 0, 1}, 10);
  b.pull("left_hand", {1, 0, 1}, 0);
  Pose out;
  b.q = b.start;
  b.solver.solve(b.q, b.goals, b.options, {}, out);
  b.goals[2].weight = 10;
  b.solver.prepare(b.goals);
  const std::size_t before = test::allocation_count();
  b.solver.solve(b.q, b.goals, b.options, {}, out);
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_EQ(b.solver.reach_tree().nodes.size(), 4u);
}

TEST(ReachTreeSolver, KeepsQuaternionsUnitAndTheirSigns) {
  Bench b(test::human());
  for (double& v : b.start) v = v == 0.0 ? 0.0 : v;
  const int elbow = b.tree->q_at(*b.tree->find_joint("right_elbow"));
  b.start[static_cast<std::size_t>(elbow + 3)] = -1.0;  // the same pose, the other sign
  b.pull("lower_torso", {0, 0, 0.9275}, 100);
  std::vector<double> last = b.start;
  for (int n = 0; n <= 200; ++n) {
    const double angle = 4.0 * M_PI * n / 200.0;
    b.goals.resize(1);
    b.pull("right_hand", {0.3 + 0.2 * std::cos(angle), -0.3, 1.2 + 0.3 * std::sin(angle)}, 10);
    const Pose out = b.solve();
    EXPECT_LT(test::worst_quaternion(*b.tree, out.q), 1e-12);
    each_quaternion(*b.tree, [&](std::size_t first) {
      const std::span<const double> was(last), is(out.q);
      EXPECT_GE(glm::dot(quat_from_xyzw(was.subspan(first, 4)), quat_from_xyzw(is.subspan(first, 4))), 0.0);
    });
    last = b.start = out.q;
  }
}

// What must hold whatever comes in.
void expect_sound(Bench& b, const char* what, int n) {
  const Pose out = b.solve();
  const Pose again = b.solve();
  ASSERT_TRUE(test::all_finite(out)) << what << " " << n;
  EXPECT_LT(test::worst_bone(*b.tree, out.world_from_segment), 1e-9) << what << " " << n;
  EXPECT_LT(test::worst_quaternion(*b.tree, out.q), 1e-12) << what << " " << n;
  ASSERT_TRUE(test::same_bytes(out.q, again.q)) << what << " " << n;
  ReachTreeSolver fresh(b.tree);
  Pose third;
  std::vector<double> q = b.start;
  fresh.solve(q, b.goals, b.options, {}, third);
  ASSERT_TRUE(test::same_bytes(out.q, third.q)) << what << " " << n;
  EXPECT_EQ(out.q, b.q);

  double terms = 0.0;
  for (const GoalReport& g : out.goals) terms += glm::length(g.force);
  if (out.report.status == SolveStatus::converged && b.tree->root_is_free()) {
    double weights = 0.0;
    for (const ReachGoal& g : b.goals) weights += pull_of(g);
    EXPECT_LT(glm::length(total_force(out)), 1e-6 * terms + 1e-9 * weights) << what << " " << n;
  }
}

TEST(ReachTreeSolver, IsSoundForRandomGoalsOfAHuman) {
  std::mt19937 random(11);
  for (int n = 0; n < 300; ++n) {
    Bench b(test::human(test::uniform(random, 0.5, 2.5)));
    for (int k = 1 + test::pick(random, 8); k > 0; --k) {
      const int segment = test::pick(random, b.tree->size());
      const double weight = std::pow(10.0, test::uniform(random, -2, 3));
      b.goals.push_back(
          {segment, b.tree->segment(segment).touch_point, test::random_point(random, 2.0), weight, 0, true});
    }
    expect_sound(b, "human", n);
  }
}

TEST(ReachTreeSolver, IsSoundForRandomFigures) {
  std::mt19937 random(12);
  for (int n = 0; n < 500; ++n) {
    Bench b(test::build(test::random_figure(random, 14)));
    for (int k = 1 + test::pick(random, 6); k > 0; --k) {
      const int segment = test::pick(random, b.tree->size());
      b.goals.push_back({segment, test::random_point(random, 0.3), test::random_point(random, 2.0),
                         test::uniform(random, 0.0, 100.0), 0, true});
    }
    b.options.root_iterations = 50;
    expect_sound(b, "figure", n);
  }
}

TEST(ReachTreeSolver, IsSoundForGoalsAtTheEndOfTheWorld) {
  const double far[] = {0.0, 1e-300, 1e6, -1e6, 1e12, -1e300, std::numeric_limits<double>::max()};
  std::mt19937 random(13);
  for (int n = 0; n < 200; ++n) {
    Bench b(test::human());
    for (int k = 1 + test::pick(random, 5); k > 0; --k) {
      const int segment = test::pick(random, b.tree->size());
      const Vec3 target{far[test::pick(random, 7)], far[test::pick(random, 7)], far[test::pick(random, 7)]};
      const double weights[] = {1e-300, 1.0, 1e6, 1e300, std::numeric_limits<double>::infinity()};
      b.goals.push_back({segment, kZero, target, weights[test::pick(random, 5)], 0, true});
    }
    const Pose out = b.solve();
    ASSERT_TRUE(test::all_finite(out)) << n;
    EXPECT_LT(test::worst_bone(*b.tree, out.world_from_segment), 1e-8) << n;
    EXPECT_LT(test::worst_quaternion(*b.tree, out.q), 1e-12) << n;
  }
}

TEST(ReachTreeSolver, IsSoundForGoalsThatCoincide) {
  Bench b(test::human());
  for (int i = 0; i < b.tree->size(); ++i) {
    b.goals.push_back({i, b.tree->segment(i).touch_point, {0, 0, 1}, 10, 0, true});
  }
  expect_sound(b, "one place for all", 0);
  for (ReachGoal& g : b.goals) g.segment = 11, g.point = kZero;
  expect_sound(b, "one segment for all", 0);
}

TEST(ReachTreeSolver, ATargetAThousandKilometresAwayIsReached) {
  Bench b(test::human());
  b.pull("right_hand", {1e6, -1e6, 1e6}, 10);
  const Pose out = b.solve();
  EXPECT_EQ(out.goals[0].state, GoalState::reached);
  EXPECT_EQ(out.report.status, SolveStatus::converged);
}

}  // namespace
}  // namespace posed
