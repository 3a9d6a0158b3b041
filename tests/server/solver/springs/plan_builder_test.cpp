#include "server/solver/springs/plan_builder.h"

#include <gtest/gtest.h>

#include "server/solver/springs/starts.h"
#include "tests/support/spring_figures.h"

namespace posed {
namespace {

TEST(PlanBuilder, ConfineBringsWholeTurnsHomeAndTheRestToTheBounds) {
  FigureDocument d = test::column(2, 0.5);
  d.segments[1].joint.type = JointType::hinge;
  d.segments[1].joint.axes = {kY};
  d.segments[1].joint.limits = {Limit{-1.0, 1.5}};
  springs::Plan plan;
  springs::State state;
  std::vector<int> link_of_segment;
  springs::add_figure(*test::build(d), 0, std::vector<char>{1, 1}, plan, link_of_segment);
  springs::resize(plan, state);
  const auto confined = [&](double turn) {
    state.turns[6] = turn;
    springs::confine(plan, state);
    return state.turns[6];
  };
  EXPECT_EQ(confined(0.7), 0.7);
  EXPECT_NEAR(confined(0.7 + 2 * M_PI), 0.7, 1e-12);
  EXPECT_NEAR(confined(0.7 - 8 * M_PI), 0.7, 1e-12);
  EXPECT_EQ(confined(1.7), 1.5);
  EXPECT_EQ(confined(-1.7), -1.0);
}

TEST(PlanBuilder, OnlyWhatGoalsTouchIsLaidOut) {
  const auto tree = test::human();
  springs::Plan plan;
  std::vector<int> link_of_segment;
  std::vector<char> active(static_cast<std::size_t>(tree->size()), 0);
  active[static_cast<std::size_t>(*tree->find_segment("right_hand"))] = 1;
  springs::add_figure(*tree, 0, active, plan, link_of_segment);
  EXPECT_EQ(plan.links.size(), 6u);  // lower and upper torso, clavicle, two arms, hand
  EXPECT_EQ(link_of_segment[static_cast<std::size_t>(*tree->find_segment("left_hand"))], -1);
}

}  // namespace
}  // namespace posed
