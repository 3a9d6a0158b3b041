#include "server/solver/kinematics.h"

#include <gtest/gtest.h>

#include "server/solver/springs/kinematics-inl.h"
#include "server/solver/springs/plan_builder.h"
#include "server/solver/springs/probe.h"
#include "server/solver/springs/starts.h"
#include "tests/support/freedoms.h"
#include "tests/support/joint_angles.h"
#include "tests/support/spring_figures.h"

namespace posed {
namespace {

namespace here = springs::HWY_NAMESPACE;

// Eight poses of one figure, one in each lane and one after the other.
struct Eight {
  std::shared_ptr<const BodyTree> tree;
  springs::Plan plan;
  std::vector<int> link_of_segment;
  std::vector<std::vector<double>> q;
  here::Steps<here::Lanes> lanes;
  std::vector<here::Steps<double>> alone;

  Eight(std::shared_ptr<const BodyTree> figure, std::mt19937& random) : tree(std::move(figure)), alone(8) {
    const std::vector<char> all(static_cast<std::size_t>(tree->size()), 1);
    springs::add_figure(*tree, 0, all, plan, link_of_segment);
    springs::State state;
    springs::resize(plan, state);
    lanes.resize(plan);
    for (int n = 0; n < 8; ++n) {
      q.push_back(test::random_q(random, *tree));
      test::read_q(*tree, 0, plan, q.back(), state);
      auto& one = alone[static_cast<std::size_t>(n)];
      one.resize(plan);
      for (std::size_t j = 0; j < state.turns.size(); ++j)
        one.turns[j] = state.turns[j], here::set_lane(lanes.turns[j], n, state.turns[j]);
      for (std::size_t j = 0; j < state.more.size(); ++j)
        one.more[j] = state.more[j], here::set_lane(lanes.more[j], n, state.more[j]);
    }
  }
};

template <class T>
Vec3 vec(const here::V3<T>& v, int lane) {
  return {here::lane(v.x, lane), here::lane(v.y, lane), here::lane(v.z, lane)};
}

template <class T>
double off(const here::Placed<T>& placed, int lane, const Transform& should) {
  double worst = glm::length(vec(placed.centre, lane) - should.position);
  worst = std::max(worst, glm::length(vec(placed.rotation.x, lane) - should.rotation * kX));
  worst = std::max(worst, glm::length(vec(placed.rotation.y, lane) - should.rotation * kY));
  return std::max(worst, glm::length(vec(placed.rotation.z, lane) - should.rotation * kZ));
}

void expect_same(Eight& eight, double close) {
  here::Kinematics<here::Lanes> together;
  here::Kinematics<double> one;
  together.resize(eight.plan);
  one.resize(eight.plan);
  together.place(eight.plan, eight.lanes);
  std::vector<Transform> world(static_cast<std::size_t>(eight.tree->size()));
  for (int n = 0; n < 8; ++n) {
    one.place(eight.plan, eight.alone[static_cast<std::size_t>(n)]);
    forward_kinematics(*eight.tree, eight.q[static_cast<std::size_t>(n)], world);
    for (int i = 0; i < eight.tree->size(); ++i) {
      const auto segment = static_cast<std::size_t>(eight.plan.links[static_cast<std::size_t>(i)].segment);
      EXPECT_LT(off(one.placed(i), 0, world[segment]), close) << n << " " << i;
      EXPECT_LT(off(together.placed(i), n, world[segment]), close) << n << " " << i;
    }
    for (std::size_t j = 0; j < eight.plan.dofs.size(); ++j) {
      if (eight.plan.dofs[j].kind == springs::DofKind::of_root) continue;
      EXPECT_LT(glm::length(vec(one.axis(j), 0) - vec(together.axis(j), n)), close) << n << " " << j;
    }
  }
}

TEST(SpringKinematics, AreThoseOfTheBodyTreeAloneAndInLanes) {
  std::mt19937 random(41);
  for (const JointType root : {JointType::free, JointType::ball, JointType::universal, JointType::hinge,
                               JointType::prismatic, JointType::fixed}) {
    SCOPED_TRACE(static_cast<int>(root));
    Eight eight(test::build(test::all_joints(root)), random);
    expect_same(eight, 1e-12);
  }
  Eight human(test::human(), random);
  expect_same(human, 1e-12);
}

TEST(SpringKinematics, OfRandomFigures) {
  std::mt19937 random(42);
  for (int n = 0; n < 200; ++n) {
    SCOPED_TRACE(n);
    Eight eight(test::build(test::random_limited_figure(random, 10)), random);
    expect_same(eight, 1e-10);  // some limbs point nearly backwards
  }
}

TEST(SpringKinematics, OfALimbThatPointsBackwards) {
  FigureDocument d = test::column(2, 0.5);
  d.segments[1].joint.twist = Limit{-3, 3};
  const auto tree = test::build(d);
  springs::Plan plan;
  std::vector<int> link_of_segment;
  springs::add_figure(*tree, 0, std::vector<char>{1, 1}, plan, link_of_segment);
  springs::State state;
  springs::resize(plan, state);
  springs::Probe probe;
  probe.prepare(plan);
  std::vector<Transform> world(2);
  for (const double near : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 0.0}) {
    auto q = tree->rest();
    const auto v = xyzw(quat_about(kX, M_PI - near) * quat_about(kZ, 0.3));
    std::copy(v.begin(), v.end(), q.begin() + 7);
    test::read_q(*tree, 0, plan, q, state);
    probe.place(plan, state);
    forward_kinematics(*tree, q, world);
    EXPECT_LT(glm::length(probe.link(1) * kX - world[1] * kX), 1e-9) << near;
  }
}

}  // namespace
}  // namespace posed
