#include "server/solver/kinematics.h"

#include <gtest/gtest.h>

#include "tests/support/figures.h"

namespace posed {
namespace {

using test::column;

std::vector<Transform> place(const BodyTree& tree, const std::vector<double>& q) {
  std::vector<Transform> world(static_cast<std::size_t>(tree.size()));
  forward_kinematics(tree, q, world);
  return world;
}

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-12) << a.x << " " << a.y << " " << a.z;
}

TEST(Kinematics, AFreeRootIsWhereItsJointValuesSay) {
  FigureDocument d = column(2, 1.0);
  d.segments[0].joint.parent_from_joint.position = {9, 9, 9};
  const auto tree = test::build(d);
  auto q = tree->rest();
  expect_near(place(*tree, q)[0].position, {9, 9, 9});
  q[0] = 1, q[1] = 2, q[2] = 3;
  const Quat turned = quat_about(kX, M_PI / 2);
  q[3] = turned.x, q[6] = turned.w;
  const auto world = place(*tree, q);
  expect_near(world[0].position, {1, 2, 3});
  expect_near(world[1].position, {1, 1, 3});  // the link along Z now points to -Y
}

TEST(Kinematics, JointsMoveInTheirFrameAtRest) {
  FigureDocument d = column(5, 1.0, JointType::fixed);
  d.segments[0].joint.parent_from_joint = {{0, 0, 5}, quat_about(kX, M_PI)};  // upside down
  d.segments[1].joint.type = JointType::hinge;
  d.segments[1].joint.axes = {kY};
  d.segments[2].joint.type = JointType::prismatic;
  d.segments[2].joint.axes = {kZ};
  d.segments[3].joint.type = JointType::fixed;
  const auto tree = test::build(d);
  EXPECT_EQ(tree->q_size(), 6);
  std::vector<double> q = {M_PI / 2, 0.5, 0, 0, 0, 1};
  const auto world = place(*tree, q);
  expect_near(world[1].position, {0, 0, 4});
  expect_near(world[2].position, {1.5, 0, 4});  // +90 degrees about Y, seen from above still towards X
  expect_near(world[3].position, {2.5, 0, 4});
  expect_near(world[4].position, {3.5, 0, 4});
}

TEST(Kinematics, ABallTurnsAllThatFollows) {
  const auto tree = test::build(column(3, 1.0));
  auto q = tree->rest();
  const Quat bent = quat_about(kY, M_PI / 2);
  q[8] = bent.y, q[10] = bent.w;
  const auto world = place(*tree, q);
  expect_near(world[1].position, {0, 0, 1});
  expect_near(world[2].position, {1, 0, 1});
  expect_near(world[2] * Vec3(0, 0, 1), {2, 0, 1});
}

TEST(Kinematics, ChecksJointValues) {
  const auto tree = test::build(column(2, 1.0));
  EXPECT_TRUE(check_q(*tree, tree->rest()));

  const std::vector<double> few(5, 0.0);
  EXPECT_EQ(check_q(*tree, few).error().code, "invalid_params");

  auto q = tree->rest();
  q[9] = std::nan("");
  EXPECT_EQ(check_q(*tree, q).error().code, "not_finite");
  EXPECT_EQ(check_q(*tree, q).error().path, "/9");

  q = tree->rest();
  q[1] = 1e7;
  EXPECT_EQ(check_q(*tree, q).error().path, "/1");

  q = tree->rest();
  q[10] = 1.1;
  EXPECT_EQ(check_q(*tree, q).error().code, "out_of_range");
  EXPECT_EQ(check_q(*tree, q).error().path, "/7");
  q[10] = 1.0 + 5e-7;
  EXPECT_TRUE(check_q(*tree, q));
}

TEST(Kinematics, KeepsTheSignOfAQuaternion) {
  const auto tree = test::build(column(2, 1.0));
  const auto before = tree->rest();
  auto q = before;
  q[10] = -1.0;
  keep_signs(*tree, before, q);
  EXPECT_EQ(q[10], 1.0);
}

}  // namespace
}  // namespace posed
