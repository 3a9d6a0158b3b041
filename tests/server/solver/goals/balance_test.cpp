#include "server/solver/goals/balance.h"

#include <gtest/gtest.h>

#include <cmath>

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

// Where edges have moved in, corners lie between no supports.
TEST(BalanceGoal, InsideAMargin) {
  test::check_alone_at_random([](std::mt19937& random, const BodyTree& tree) {
    std::vector<AttachedPoint> support;
    for (const Vec3& corner : {Vec3(1, 1, 0), Vec3(1, -1, 0), Vec3(-1, 1, 0), Vec3(-1, -1, 0), Vec3(2, 0, 0)})
      support.push_back({test::pick(random, tree.size()), 2.0 * corner + test::random_point(random, 0.2)});
    return balance(support, 0.1);
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

// The distance from a region with corners: told by the nearest edge alone it had ridges there, and a centre of mass
// that had to come in between two edges stood still on one.
TEST(Footing, InACornerOfTheMarginItIsTheCornerThatIsNear) {
  const auto f = springs::footing(kSquare, {0.8, 0.9}, 0.5);
  EXPECT_NEAR(f.outside, 0.5, 1e-12);
  EXPECT_NEAR(f.way_x, 0.6, 1e-12);
  EXPECT_NEAR(f.way_y, 0.8, 1e-12);
  EXPECT_NEAR(f.round, 0.5, 1e-12);
}

TEST(Footing, EdgesThatTheMarginSwallowsAreNoMore) {
  std::vector<Ground> cut = kSquare;
  cut[1] = {1, 0.9}, cut.push_back({0.9, 1});
  EXPECT_NEAR(springs::footing(cut, {0.8, 0.9}, 0.5).outside, 0.5, 1e-12);
  EXPECT_NEAR(springs::footing(cut, {0.98, 0.98}, 0.0).outside, 0.06 / std::sqrt(2.0), 1e-12);
}

TEST(Footing, MoreIsMoreOfTheMargin) {
  for (const Ground& mass : {Ground{0.8, 0.9}, Ground{0.1, 0.2}, Ground{3, 0}}) {
    EXPECT_NEAR(springs::footing(kSquare, mass, 0.2, 0.3).outside, springs::footing(kSquare, mass, 0.5).outside, 1e-12);
    EXPECT_NEAR(springs::footing(kSquare, mass, 0.0, -0.3).outside, springs::footing(kSquare, mass, 0.0).outside - 0.3,
                1e-12);
    // There is no room for so much.
    EXPECT_NEAR(springs::footing(kSquare, mass, 0.4, 2.0).outside, springs::footing(kSquare, mass, 0.9).outside + 1.5,
                1e-12);
    EXPECT_NEAR(springs::footing(kSquare, mass, 5.0).outside, springs::footing(kSquare, mass, 0.9).outside, 1e-12);
  }
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

// However thin the hull, and however far from the origin: there the margin leaves less than rounding does.
TEST(Footing, ThinHullsHaveAnAnswer) {
  std::mt19937 random(76);
  for (int n = 0; n < 2000; ++n) {
    const double thin = std::pow(10.0, -test::uniform(random, 0.0, 16.0));
    const double away = n % 2 == 0 ? 0.0 : std::pow(10.0, test::uniform(random, 0.0, 6.0));
    std::vector<Ground> supports;
    for (int k = 0; k < 4; ++k) {
      const Vec3 p = test::random_point(random, 1.0);
      supports.push_back({away + p.x, away + 0.5 * p.x + thin * p.y});
    }
    const Vec3 p = test::random_point(random, 2.0);
    for (const double more : {0.0, 0.1}) {
      const auto f = springs::footing(supports, {away + p.x, away + p.y}, 0.05, more);
      EXPECT_NEAR(std::hypot(f.way_x, f.way_y), 1.0, 1e-9) << n;
      EXPECT_LT(std::abs(f.outside), 5.0) << n;
      for (const auto& edge : f.edges) EXPECT_TRUE(std::isfinite(edge.of_way * edge.share)) << n;
    }
  }
}

TEST(Footing, AllPointsCount) {
  std::vector<Ground> many(springs::kMostSupports - 1, Ground{0, 0});
  many.push_back({5, 0});
  EXPECT_NEAR(springs::footing(many, {7, 0}, 0.0).outside, 2.0, 1e-12);
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
