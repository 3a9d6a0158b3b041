#include "server/solver/springs/swing.h"

#include <gtest/gtest.h>

#include "server/solver/springs/spring_solver.h"
#include "tests/support/spring_figures.h"
#include "tests/support/spring_judge.h"

namespace posed {
namespace {

springs::Link link_with(const Swing& swing, const Vec3& limb = kZ) {
  springs::Link link;
  springs::make_limb(limb, swing, link);
  return link;
}

Segment segment_with(const Swing& swing) {
  Segment segment;
  segment.touch_point = kZ;
  segment.joint.swing = swing;
  return segment;
}

double beyond(const Swing& swing, const Vec3& d) {
  double worst = -10.0;
  for (const double b : test::beyond_swing(segment_with(swing), d)) worst = std::max(worst, b);
  return worst;
}

std::vector<Swing> swings() {
  Swing aside = test::ellipse(1.2, 0.4);
  aside.center = glm::normalize(Vec3(1, 1, -0.5));
  Swing wide = test::ellipse(3.0, 2.5);
  return {test::ellipse(0.9, 0.5),
          test::ellipse(0.01, 1.5),
          aside,
          wide,
          test::polygon({{1, 0.2, 1}, {0.1, 1, 1}, {-0.8, 0, 1}, {0, -1, 1.2}}),
          test::polygon({{1, 0, 0.2}, {-0.5, 0.9, 0.2}, {-0.5, -0.9, 0.2}}),
          test::polygon({{0.01, 0, 1}, {-0.005, 0.009, 1}, {-0.005, -0.009, 1}})};
}

TEST(Swing, WhatIsInsideStaysAndWhatIsOutsideComesToTheEdge) {
  std::mt19937 random(51);
  for (const Swing& swing : swings()) {
    for (int n = 0; n < 2000; ++n) {
      const Vec3 d = glm::normalize(test::random_point(random, 1.0) + Vec3(0, 0, 1e-3));
      const Vec3 kept = springs::inside_swing(link_with(swing), d);
      EXPECT_NEAR(glm::length(kept), 1.0, 1e-12);
      EXPECT_LT(beyond(swing, kept), 1e-9) << d.x << " " << d.y << " " << d.z;
      if (beyond(swing, d) < -1e-9) {
        EXPECT_LT(glm::length(kept - d), 1e-12);
      } else {
        EXPECT_GT(beyond(swing, kept), -1e-6) << n;
      }
    }
  }
}

TEST(Swing, TheCornersOfAPolygonAreInside) {
  for (const Swing& swing : swings()) {
    for (const Vec3& c : swing.corners) EXPECT_LT(glm::length(springs::inside_swing(link_with(swing), c) - c), 1e-9);
  }
}

// A limb of 1 m on a fixed base that is pulled to a far point: it comes to rest where, of all it may point to, is
// nearest.
double best_cost(const Swing& swing, const Vec3& target) {
  std::mt19937 random(53);
  double best = 1e300, reach = 1.0;
  Vec3 at = kZ;
  for (int n = 0; n < 20'000; ++n) {
    const Vec3 d = glm::normalize((n < 10'000 ? kZero : at) + test::random_point(random, reach));
    if (n >= 10'000) reach *= 0.998;
    if (beyond(swing, d) > 0.0) continue;
    const double cost = 10.0 * glm::dot(d - target, d - target);
    if (cost < best) best = cost, at = d;
  }
  return best;
}

TEST(Swing, ExactlyBehindTheCentreTooItComesToTheEdge) {
  for (const Swing& swing : swings()) {
    const Vec3 d = springs::inside_swing(link_with(swing), swing.center == kZero ? -kZ : -swing.center);
    EXPECT_NEAR(glm::length(d), 1.0, 1e-12);
    EXPECT_LT(beyond(swing, d), 1e-9);
  }
}

TEST(Swing, APulledLimbSlidesAlongTheEdgeToTheBestPlace) {
  std::mt19937 random(52);
  int worse = 0, all = 0;
  for (const Swing& swing : swings()) {
    FigureDocument d = test::column(2, 1.0, JointType::fixed);
    d.segments[1].joint.swing = swing;
    const auto tree = test::build(d);
    SpringSolver solver(tree);
    for (int n = 0; n < 6; ++n) {
      const Vec3 target = 2.0 * glm::normalize(test::random_point(random, 1.0) + Vec3(0, 0, 1e-3));
      const std::vector<SpringGoal> goals = {
          test::goal_at(*tree, "s1", PositionSpring{tree->segment(1).joint.parent_from_joint.position + target})};
      SpringPose pose;
      pose.q = {tree->rest()};
      solver.solve(goals, {}, {}, pose);
      EXPECT_LT(test::beyond_limits(*tree, pose.q[0]), 1e-9) << n;
      EXPECT_LT(test::unbalance({tree}, goals, pose.q), 1e-4) << n;
      ++all;
      // A polygon has one valley; so has an ellipse, but for targets behind it.
      worse += pose.report.cost > best_cost(swing, target) + 1e-2;
    }
  }
  EXPECT_LE(worse, all / 10);
}

}  // namespace
}  // namespace posed
