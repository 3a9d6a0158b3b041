// What must hold whatever comes in. Each group is of 2,500 problems, and of 250 where sanitizers look at each of them.
#include <gtest/gtest.h>

#include "tests/support/spring_bench.h"

namespace posed {
namespace {

using test::SpringBench;

#if defined(__has_feature)  // clang
#define POSED_SANITIZED __has_feature(address_sanitizer)
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define POSED_SANITIZED 1
#else
#define POSED_SANITIZED 0
#endif
constexpr int kProblems = POSED_SANITIZED ? 250 : 2500;

std::shared_ptr<const BodyTree> some_figure(std::mt19937& random, int n) {
  switch (n % 8) {
    case 0:
      return test::human();
    case 1:
      return test::build(test::hand_with_fingers());
    case 2:
      return test::build(test::quadruped());
    case 3:
      return test::build(
          test::column(2 + test::pick(random, 20), 0.2, n % 2 == 0 ? JointType::free : JointType::fixed));
    default:
      return test::build(test::random_limited_figure(random, 14));
  }
}

bool sound(const SpringPose& pose) {
  for (std::size_t f = 0; f < pose.q.size(); ++f) {
    Pose one;
    one.q = pose.q[f];
    one.world_from_segment = pose.world_from_segment[f];
    one.goals = pose.goals;
    one.report = pose.report;
    if (!test::all_finite(one)) return false;
  }
  return true;
}

void expect_sound(SpringBench& b, int n) {
  const SpringPose out = b.solve();
  ASSERT_TRUE(sound(out)) << n;
  double away = 1.0;
  for (const auto& world : out.world_from_segment) {
    for (const Transform& t : world) away = std::max(away, glm::length(t.position));
  }
  for (std::size_t f = 0; f < b.figures.size(); ++f) {
    EXPECT_LT(test::worst_quaternion(*b.figures[f], out.q[f]), 1e-9) << n;
    EXPECT_LT(test::worst_bone(*b.figures[f], out.world_from_segment[f]), 1e-9 * away) << n;
    for (int i = 0; i < b.figures[f]->size(); ++i)
      EXPECT_LT(test::beyond_limits(*b.figures[f], out.q[f], i), 1e-9)
          << n << " " << b.figures[f]->segment(i).name << (b.figures[f]->joint(i).swing ? " swing " : " type ")
          << static_cast<int>(b.figures[f]->joint(i).type);
  }
  for (std::size_t g = 0; g < b.goals.size(); ++g) {
    const GoalReport& r = out.goals[g];
    EXPECT_EQ(r.state == GoalState::off, !pulls(b.goals[g])) << n << " " << g;
    if (r.state == GoalState::off) continue;
    const bool posture = std::holds_alternative<PostureSpring>(b.goals[g].spring);  // 0.01 rad a joint
    EXPECT_TRUE(r.state != GoalState::reached || posture || r.error <= 1e-2) << n << " " << g;
    EXPECT_TRUE(r.state != GoalState::limited || !r.causes.empty()) << n << " " << g;
    for (const Cause& c : r.causes) {
      EXPECT_TRUE(c.kind != Cause::Kind::goal || c.goal != static_cast<int>(g)) << n;
    }
  }
}

void add_goals(std::mt19937& random, SpringBench& b, int most, double reach) {
  for (int k = 1 + test::pick(random, most); k > 0; --k) {
    b.goals.push_back(test::random_goal(random, b.figures, test::pick(random, test::kKinds), reach));
    b.goals.back().weight = std::pow(10.0, test::uniform(random, -1.0, 3.0));
    if (test::pick(random, 6) == 0) b.goals.back().priority = test::pick(random, 3) - 1;
  }
}

TEST(Soundness, OfReachableGoals) {
  std::mt19937 random(111);
  for (int n = 0; n < kProblems; ++n) {
    SpringBench b(some_figure(random, n));
    const test::AllQ there = {test::random_q(random, *b.figures[0])};
    std::vector<Transform> world(static_cast<std::size_t>(b.figures[0]->size()));
    forward_kinematics(*b.figures[0], there[0], world);
    for (int k = 1 + test::pick(random, 6); k > 0; --k) {
      SpringGoal goal = test::random_goal(random, b.figures, 0, 1.0);
      goal.base_segment = -1, goal.world_from_base = {};
      goal.spring = PositionSpring{world[static_cast<std::size_t>(goal.at.segment)] * goal.at.point};
      b.goals.push_back(goal);
    }
    b.start = {test::random_q(random, *b.figures[0])};
    b.options.cold = n % 3 == 0;
    b.options.explore = n % 3 == 1;
    expect_sound(b, n);
  }
}

TEST(Soundness, OfGoalsOfAllKindsOutOfReach) {
  std::mt19937 random(112);
  for (int n = 0; n < kProblems; ++n) {
    SpringBench b(some_figure(random, n));
    add_goals(random, b, 8, 5.0);
    b.start = {test::random_q(random, *b.figures[0])};
    b.options.cold = n % 3 == 0;
    b.options.explore = n % 3 == 1;
    expect_sound(b, n);
  }
}

TEST(Soundness, OfDegenerateGoals) {
  std::mt19937 random(113);
  for (int n = 0; n < kProblems; ++n) {
    SpringBench b(some_figure(random, n));
    add_goals(random, b, 6, 1.0);
    b.start = {test::random_q(random, *b.figures[0])};
    for (SpringGoal& goal : b.goals) {
      if (n % 5 == 0) goal.weight = goal.orientation_weight = 0.0;                 // all off
      if (n % 5 == 1) goal.at = b.goals[0].at, goal.figure = b.goals[0].figure;    // one place takes them all
      if (n % 5 == 2) goal.at.point = kZero, goal.base_segment = goal.at.segment;  // relative to itself
      if (n % 5 == 3 && test::pick(random, 2) == 0) goal.world_from_base.position = {1e6, -1e6, 1e6};
      if (n % 5 == 4) goal = b.goals[0];  // the same twice
    }
    b.options.cold = n % 2 == 0;
    b.options.explore = n % 4 == 1;
    expect_sound(b, n);
  }
}

TEST(Soundness, OfFiguresTiedTogether) {
  std::mt19937 random(114);
  for (int n = 0; n < kProblems; ++n) {
    SpringBench b(test::Figures{some_figure(random, n), some_figure(random, n / 8)});
    add_goals(random, b, 5, 2.0);
    for (std::size_t f = 0; f < 2; ++f) {
      b.start[f] = test::random_q(random, *b.figures[f]);
    }
    b.options.iterations = n % 4 == 0 ? 3 : 200;
    b.options.cold = n % 3 == 0;
    expect_sound(b, n);
  }
}

}  // namespace
}  // namespace posed
