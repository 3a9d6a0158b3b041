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

}  // namespace
}  // namespace posed
