#include "server/solver/goals/balance.h"

#include <gtest/gtest.h>

#include "tests/server/solver/goals/derivative_check.h"

namespace posed {
namespace {

SpringGoal balance(std::vector<AttachedPoint> support, double margin) {
  SpringGoal goal;
  goal.spring = BalanceSpring{std::move(support), margin};
  return goal;
}

TEST(BalanceGoal, OnAPoint) {
  test::check_alone_at_random([](std::mt19937& random, const BodyTree&) {
    return balance({{1 + test::pick(random, 8), test::random_point(random, 0.5)}}, 0.0);
  });
}

TEST(BalanceGoal, OnALine) {
  test::check_alone_at_random([](std::mt19937& random, const BodyTree&) {
    return balance({{2, test::random_point(random, 0.5)}, {5, test::random_point(random, 0.5)}}, 0.0);
  });
}

TEST(BalanceGoal, OnAnArea) {
  test::check_alone_at_random([](std::mt19937& random, const BodyTree& tree) {
    std::vector<AttachedPoint> support;
    for (int k = 0; k < 5; ++k) support.push_back({test::pick(random, tree.size()), test::random_point(random, 0.4)});
    return balance(support, 1e-3);
  });
}

using springs::Ground;

const std::vector<Ground> kSquare = {{-1, -1}, {1, 1}, {1, -1}, {-1, 1}, {0, 0}};

TEST(Footing, TellsHowFarOutside) {
  EXPECT_NEAR(springs::footing(kSquare, {3, 0}, 0.0).outside, 2.0, 1e-12);
  EXPECT_NEAR(springs::footing(kSquare, {4, 5}, 0.0).outside, 5.0, 1e-12);
  EXPECT_NEAR(springs::footing(kSquare, {0.75, 0}, 0.0).outside, -0.25, 1e-12);
  EXPECT_NEAR(springs::footing(kSquare, {0.75, 0}, 0.5).outside, 0.25, 1e-12);
}

TEST(Footing, TheWayIsStraightOut) {
  for (const double x : {3.0, 0.75}) {
    const auto f = springs::footing(kSquare, {x, 0.1}, 0.5);
    EXPECT_NEAR(f.way_x, 1.0, 1e-12) << x;
    EXPECT_NEAR(f.way_y, 0.0, 1e-12) << x;
  }
}

TEST(Footing, OnTheEdgeTheWayIsStillOut) {
  for (const Ground& mass : {Ground{1, 0.3}, Ground{-1, 0.3}, Ground{0.3, 1}, Ground{0.3, -1}}) {
    const auto f = springs::footing(kSquare, mass, 0.1);
    EXPECT_NEAR(f.outside, 0.1, 1e-12);
    EXPECT_GT(f.way_x * mass.x + f.way_y * mass.y, 0.9) << mass.x << " " << mass.y;
  }
}

TEST(Footing, PointsAtOnePlace) {
  const std::vector<Ground> heap(3, Ground{1, 1});
  const auto f = springs::footing(heap, {1, 3}, 0.2);
  EXPECT_NEAR(f.outside, 2.0, 1e-12);
  EXPECT_NEAR(f.way_y, 1.0, 1e-12);
  EXPECT_NEAR(springs::footing(heap, {1, 1}, 0.2).outside, 0.0, 1e-12);
}

}  // namespace
}  // namespace posed
