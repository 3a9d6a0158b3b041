// A scene at 240 Hz: each frame starts from the answer before.
#include <gtest/gtest.h>

#include "tests/support/spring_bench.h"

namespace posed {
namespace {

using test::SpringBench;

// The largest motion of a joint from one pose to the next, rad or m; of balls the angle between. Roots apart.
double fastest(const BodyTree& tree, const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (int i = 0; i < tree.size(); ++i) {
    const auto at = static_cast<std::size_t>(tree.q_at(i));
    const int size = q_size(tree.joint(i).type);
    if (size == 1) most = std::max(most, std::abs(a[at] - b[at]));
    if (size != 4) continue;
    const auto limb = test::spans(tree, a, i), then = test::spans(tree, b, i);
    if (test::is_limb(tree.joint(i)) || limb.empty()) {
      const Quat turn =
          glm::conjugate(quat_from_xyzw(std::span(a).subspan(at, 4))) * quat_from_xyzw(std::span(b).subspan(at, 4));
      most = std::max(most, 2.0 * std::atan2(glm::length(Vec3(turn.x, turn.y, turn.z)), std::abs(turn.w)));
    } else {
      for (std::size_t k = 0; k < limb.size(); ++k) most = std::max(most, std::abs(limb[k].value - then[k].value));
    }
  }
  return most;
}

void expect_bounded(std::shared_ptr<const BodyTree> tree, const char* end, const Vec3& centre) {
  SpringBench b(std::move(tree));
  b.options.most_turn = 0.05;
  b.pull(end, centre);
  for (int n = 0; n < 240; ++n) {
    // Round and round, and every 60 frames a leap to the other side.
    const double angle = 2.0 * M_PI * n / 120.0, side = n / 60 % 2 == 0 ? 1.0 : -1.0;
    b.goals[0].spring = PositionSpring{centre + Vec3(0.3 * std::cos(angle), 0.4 * side, 0.3 * std::sin(angle))};
    const SpringPose out = b.solve();
    // Three degrees of freedom at the bound each.
    ASSERT_LE(fastest(*b.figures[0], b.start[0], out.q[0]), 0.05 * std::sqrt(3.0) + 1e-9) << n;
    b.start = out.q;
  }
}

TEST(Stream, NoJointIsFasterThanTheBound) {
  expect_bounded(test::human(), "right_hand", {0.4, -0.3, 1.3});
}

// A hand of weight 10 follows a curve, feet and pelvis are held with 100.
struct Dance : SpringBench {
  Vec3 hand;
  bool pinned;
  explicit Dance(bool with_pins = false) : SpringBench(test::human()), hand(touch("right_hand")), pinned(with_pins) {
    pull("right_hand", hand);
    for (const char* held : {"left_foot", "right_foot", "lower_torso"}) {
      pull(held, touch(held), 100.0);
      if (pinned) goals.back().priority = kPinPriority;
    }
    options.explore = true;
  }
  void frame(int n) {
    const double t = n / 240.0;
    goals[0].spring = PositionSpring{hand + Vec3(0.20 * (1.0 - std::cos(3.0 * t)), 0.10 * (std::cos(2.0 * t) - 1.0),
                                                 0.25 * (1.0 - std::cos(2.5 * t)))};
  }
};

void expect_accurate(bool pinned) {
  Dance quick(pinned), full(pinned);
  quick.options.accuracy = 5e-5;
  double worst = 0.0;
  for (int n = 0; n < 480; ++n) {
    quick.frame(n), full.frame(n);
    full.start = quick.start;
    const SpringPose a = quick.solve(), b = full.solve();
    for (std::size_t g = 0; g < 4; ++g) worst = std::max(worst, glm::length(a.goals[g].touch - b.goals[g].touch));
    EXPECT_FALSE(a.report.branch_changed) << n;
    quick.start = a.q;
  }
  EXPECT_LT(worst, 1e-4);
}

TEST(Stream, TouchPointsAreWithinATenthOfAMillimetre) {
  expect_accurate(false);
}

TEST(Stream, JointsDoNotWindUp) {
  Dance b;
  for (int n = 0; n < 3 * 1508; ++n) {  // the curve comes back about every 1508 frames
    b.frame(n);
    const SpringPose out = b.solve();
    EXPECT_TRUE(n == 0 || fastest(*b.figures[0], b.start[0], out.q[0]) < 0.2) << n;
    b.start = out.q;
  }
}

TEST(Stream, AndUnderPins) {
  expect_accurate(true);
}

// The arm bent backwards is a valley of its own; the other start is left alone unless it saves 30 %.
TEST(Stream, AWarmStartIsLeftOnlyForAMuchBetterOne) {
  std::mt19937 random(101);
  int changed = 0;
  for (int n = 0; n < 200; ++n) {
    SpringBench warm(test::human());
    warm.start = {test::random_q(random, *warm.figures[0])};
    for (int k = 0; k < (n % 2 == 0 ? 3 : 8); ++k)
      warm.goals.push_back(test::random_goal(random, warm.figures, 0, 1.2));
    const SpringPose stays = warm.solve();
    warm.options.explore = true;
    const SpringPose explored = warm.solve();
    const double before = warm.cost(stays.q), after = warm.cost(explored.q);
    if (explored.report.branch_changed) {
      ++changed;
      EXPECT_LT(after, 0.7 * before + 1e-12) << n;
    } else {
      EXPECT_TRUE(test::same_bytes(stays.q, explored.q)) << n << " cost " << before << " -> " << after;
    }
    EXPECT_NEAR(explored.report.cost, after, 1e-6 * std::max(1.0, after)) << n;
  }
  EXPECT_GT(changed, 0);
}

TEST(Stream, NoFreeBallIsFasterThanTheBound) {
  expect_bounded(test::build(test::column(4, 0.4, JointType::fixed)), "s3", {0.6, 0, 0.8});
}

TEST(Stream, NoLimbIsFasterThanTheBound) {
  FigureDocument d = test::column(4, 0.4, JointType::fixed);
  for (std::size_t i = 1; i < 4; ++i) d.segments[i].joint.swing = test::ellipse(1.5, 1.2);
  expect_bounded(test::build(d), "s3", {0.6, 0, 0.8});
}

}  // namespace
}  // namespace posed
