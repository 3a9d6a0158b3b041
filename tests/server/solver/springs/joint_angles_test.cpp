#include "server/solver/springs/joint_angles.h"

#include <gtest/gtest.h>

#include "server/solver/kinematics.h"
#include "server/solver/springs/plan_builder.h"
#include "server/solver/springs/starts.h"
#include "tests/support/freedoms.h"
#include "tests/support/joint_angles.h"
#include "tests/support/spring_figures.h"

namespace posed {
namespace {

using springs::Plan;
using springs::State;

struct Laid {
  std::shared_ptr<const BodyTree> tree;
  Plan plan;
  std::vector<int> link_of_segment;
  State state;

  explicit Laid(std::shared_ptr<const BodyTree> figure) : tree(std::move(figure)) {
    const std::vector<char> all(static_cast<std::size_t>(tree->size()), 1);
    springs::add_figure(*tree, 0, all, plan, link_of_segment);
    springs::resize(plan, state);
  }
  std::vector<double> there_and_back(const std::vector<double>& q) {
    test::read_q(*tree, 0, plan, q, state);
    std::vector<double> out = q;
    test::write_q(*tree, 0, plan, state, out);
    return out;
  }
};

// Of the places of all segments and their touch points.
double distance(const BodyTree& tree, const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<Transform> here(static_cast<std::size_t>(tree.size())), there(here);
  forward_kinematics(tree, a, here);
  forward_kinematics(tree, b, there);
  double worst = 0.0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    for (const Vec3& p : {kZero, kX, kY, kZ}) worst = std::max(worst, glm::length(here[i] * p - there[i] * p));
  }
  return worst;
}

void expect_round_trips(const std::shared_ptr<const BodyTree>& tree, std::mt19937& random, int runs) {
  Laid laid(tree);
  for (int n = 0; n < runs; ++n) {
    const auto q = test::random_q(random, *tree);
    const auto back = laid.there_and_back(q);
    ASSERT_LT(distance(*tree, q, back), 1e-12 * tree->size()) << n;
    for (std::size_t k = 0; k < q.size(); ++k) EXPECT_NEAR(q[k], back[k], 1e-11) << n << " " << k;
  }
}

TEST(JointAngles, JointValuesComeBackFromTheState) {
  std::mt19937 random(31);
  for (const JointType root : {JointType::free, JointType::ball, JointType::universal, JointType::hinge,
                               JointType::prismatic, JointType::fixed}) {
    SCOPED_TRACE(static_cast<int>(root));
    expect_round_trips(test::build(test::all_joints(root)), random, 200);
  }
  expect_round_trips(test::human(), random, 200);
  expect_round_trips(test::build(test::hand_with_fingers()), random, 50);
}

TEST(JointAngles, OfRandomFiguresToo) {
  std::mt19937 random(32);
  for (int n = 0; n < 300; ++n) {
    SCOPED_TRACE(n);
    expect_round_trips(test::build(test::random_limited_figure(random, 12)), random, 3);
  }
}

TEST(JointAngles, ABoxedBallOnItsSideKeepsItsTurn) {
  FigureDocument d = test::column(2, 0.5);
  d.segments[1].joint.limits = {Limit{-3, 3}, Limit{-2, 2}, Limit{-3, 3}};
  Laid laid(test::build(d));
  for (const double side : {1.0, -1.0}) {
    for (const double near : {0.0, 1e-9, 1e-7, 1e-5}) {
      auto q = laid.tree->rest();
      const auto v = xyzw(quat_about(kX, 0.4) * quat_about(kY, side * (M_PI / 2 - near)) * quat_about(kZ, 0.9));
      std::copy(v.begin(), v.end(), q.begin() + 7);
      EXPECT_LT(distance(*laid.tree, q, laid.there_and_back(q)), 1e-7) << side << " " << near;
    }
  }
}

// Where y ends just at a quarter turn, x and z are told apart no more.
TEST(JointAngles, ABoxedBallOnItsSideIsReadInsideItsLimits) {
  FigureDocument d = test::boxed_human();
  const int shoulder = *test::build(d)->find_joint("left_shoulder");
  d.segments[static_cast<std::size_t>(shoulder)].joint.limits[1]->min = -M_PI / 2;
  Laid laid(test::build(d));
  std::mt19937 random(36);
  for (int n = 0; n < 200; ++n) {
    auto q = laid.tree->rest();
    const Limit x = *laid.tree->joint(shoulder).limits[0], z = *laid.tree->joint(shoulder).limits[2];
    const auto v = xyzw(quat_about(kX, test::uniform(random, x.min, x.max)) * quat_about(kY, -M_PI / 2) *
                        quat_about(kZ, test::uniform(random, z.min, z.max)));
    std::copy(v.begin(), v.end(), q.begin() + laid.tree->q_at(shoulder));
    test::read_q(*laid.tree, 0, laid.plan, q, laid.state);
    springs::confine(laid.plan, laid.state);
    auto back = q;
    test::write_q(*laid.tree, 0, laid.plan, laid.state, back);
    EXPECT_LT(distance(*laid.tree, q, back), 1e-7) << n;
  }
}

// Rx(0.1) Ry(2.2) Rz(0.3) is Rx(0.1 + pi) Ry(pi - 2.2) Rz(0.3 + pi) too, which these limits do not allow.
TEST(JointAngles, ABoxBeyondAQuarterTurnIsReadInsideItsLimits) {
  FigureDocument d = test::column(2, 0.5);
  d.segments[1].joint.limits = {Limit{-0.5, 0.5}, Limit{1.8, 2.5}, Limit{-0.5, 0.5}};
  Laid laid(test::build(d));
  auto q = laid.tree->rest();
  const auto v = xyzw(quat_about(kX, 0.1) * quat_about(kY, 2.2) * quat_about(kZ, 0.3));
  std::copy(v.begin(), v.end(), q.begin() + 7);
  test::read_q(*laid.tree, 0, laid.plan, q, laid.state);
  EXPECT_NEAR(laid.state.turns[6], 0.1, 1e-12);
  EXPECT_NEAR(laid.state.turns[7], 2.2, 1e-12);
  EXPECT_NEAR(laid.state.turns[8], 0.3, 1e-12);
}

TEST(JointAngles, ALimbThatPointsBackwardsComesBack) {
  FigureDocument d = test::column(2, 0.5);
  d.segments[1].joint.twist = Limit{-3, 3};
  Laid laid(test::build(d));
  std::mt19937 random(33);
  for (const double near : {0.0, 1e-12, 1e-9, 1e-6, 1e-3}) {
    auto q = laid.tree->rest();
    const Vec3 side = perpendicular(kZ, test::random_point(random, 1.0));
    const auto v = xyzw(quat_about(side, M_PI - near) * quat_about(kZ, 0.3));
    std::copy(v.begin(), v.end(), q.begin() + 7);
    EXPECT_LT(distance(*laid.tree, q, laid.there_and_back(q)), 1e-6) << near;
  }
}

TEST(JointAngles, TheSignOfQuaternionsStays) {
  Laid laid(test::human());
  std::mt19937 random(34);
  auto q = test::random_q(random, *laid.tree);
  each_quaternion(*laid.tree, [&](std::size_t first) {
    if (test::pick(random, 2) == 0) {
      for (std::size_t k = first; k < first + 4; ++k) q[k] = -q[k];
    }
  });
  const auto back = laid.there_and_back(q);
  for (std::size_t k = 0; k < q.size(); ++k) EXPECT_NEAR(q[k], back[k], 1e-11) << k;
}

TEST(JointAngles, ConfinedValuesAreInsideTheirLimits) {
  std::mt19937 random(35);
  for (int n = 0; n < 500; ++n) {
    Laid laid(test::build(test::random_limited_figure(random, 10)));
    auto q = laid.tree->rest();
    for (double& v : q) v = test::uniform(random, -4.0, 4.0);
    normalise_quaternions(*laid.tree, q);
    test::read_q(*laid.tree, 0, laid.plan, q, laid.state);
    springs::confine(laid.plan, laid.state);
    test::write_q(*laid.tree, 0, laid.plan, laid.state, q);
    for (int i = 0; i < laid.tree->size(); ++i) {
      const auto& swing = laid.tree->joint(i).swing;
      if (swing && swing->kind == Swing::Kind::polygon) continue;  // Swing.WhatIsInside...
      EXPECT_LT(test::beyond_limits(*laid.tree, q, i), 1e-9) << n << " " << i;
    }
  }
}

}  // namespace
}  // namespace posed
