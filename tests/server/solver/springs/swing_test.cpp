#include "server/solver/springs/swing.h"

#include <gtest/gtest.h>

#include "server/solver/springs/spring_solver.h"
#include "tests/support/spring_figures.h"
#include "tests/support/spring_judge.h"

namespace posed {
namespace {

springs::Link link_with(const Swing& swing, const Vec3& limb = kZ) {
  springs::Link link;
  link.kind = springs::LinkKind::limb;
  link.limb = limb;
  link.swing = swing;
  if (link.swing.center == kZero) link.swing.center = limb;
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

TEST(Swing, WhatIsInsideAnEllipseStaysAndWhatIsOutsideComesToTheEdge) {
  std::mt19937 random(51);
  for (const Swing& swing : swings()) {
    if (swing.kind == Swing::Kind::polygon) continue;
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

}  // namespace
}  // namespace posed
