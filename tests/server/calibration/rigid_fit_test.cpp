#include "server/calibration/rigid_fit.h"

#include <gtest/gtest.h>

#include <random>

namespace posed::calibration {
namespace {

const Transform kWorldFromSource{{1.5, -0.4, 0.8}, glm::normalize(quat_from_xyzw(0.3, -0.2, 0.7, 0.5))};

// `places` in the source's frame, and where they are in the world, off by up to `noise` metres each way.
std::vector<AlignedPoint> touched(const std::vector<Vec3>& places, double noise = 0.0, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-noise, noise);
  std::vector<AlignedPoint> points;
  for (const Vec3& place : places)
    points.push_back({place + Vec3(off(random), off(random), off(random)), kWorldFromSource * place, 0.0});
  return points;
}

void expect_near(const Transform& a, const Transform& b, double metres, double turn) {
  EXPECT_LT(glm::length(a.position - b.position), metres);
  EXPECT_GT(std::abs(glm::dot(a.rotation, b.rotation)), std::cos(0.5 * turn));
}

TEST(RigidFit, ThreePointsAreEnough) {
  const auto fit = fit_rigid(touched({{0, 0, 0}, {0.6, 0, 0}, {0, 0.4, 0}}));
  ASSERT_TRUE(fit) << fit.error().message;
  expect_near(fit->world_from_source, kWorldFromSource, 1e-12, 1e-7);
  EXPECT_LT(fit->residual_m, 1e-12);
}

TEST(RigidFit, AHalfTurnAndAQuarterTurnAreFoundToo) {
  for (const Quat& turn : {quat_about(kX, M_PI), quat_about(kY, M_PI), quat_about(kZ, M_PI / 2), quat_identity()}) {
    std::vector<AlignedPoint> points;
    for (const Vec3& p : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 0)})
      points.push_back({p, turn * p + Vec3(3, 2, 1), 0.0});
    const auto fit = fit_rigid(points);
    ASSERT_TRUE(fit);
    expect_near(fit->world_from_source, {{3, 2, 1}, turn}, 1e-12, 1e-7);
  }
}

// The fit is the least squares one: whatever is changed of it a little makes the sum of squares larger.
TEST(RigidFit, NothingNearbyFitsBetter) {
  const auto points = touched({{0, 0, 0}, {0.6, 0, 0}, {0, 0.4, 0}, {0.3, 0.2, 0.5}, {0.5, 0.5, 0.1}}, 0.01);
  const auto fit = fit_rigid(points);
  ASSERT_TRUE(fit);
  const auto sum = [&points](const Transform& t) {
    double all = 0.0;
    for (const AlignedPoint& p : points) all += glm::dot(t * p.source - p.world, t * p.source - p.world);
    return all;
  };
  const double best = sum(fit->world_from_source);
  EXPECT_NEAR(std::sqrt(best / 5.0), fit->residual_m, 1e-12);
  for (const Vec3& axis : {kX, kY, kZ, -kX, -kY, -kZ}) {
    Transform moved = fit->world_from_source, turned = fit->world_from_source;
    moved.position += 1e-4 * axis;
    turned.rotation = quat_about(axis, 1e-4) * turned.rotation;
    EXPECT_GT(sum(moved), best);
    EXPECT_GT(sum(turned), best);
  }
}

TEST(RigidFit, TheWorstPointHasTheLargestResidual) {
  auto points = touched({{0, 0, 0}, {0.6, 0, 0}, {0, 0.4, 0}, {0.6, 0.4, 0}, {0.3, 0.2, 0.4}});
  points[3].source.z += 0.05;  // mistouched
  const auto fit = fit_rigid(points);
  ASSERT_TRUE(fit);
  for (std::size_t i = 0; i < fit->points.size(); ++i) {
    if (i == 3) continue;
    EXPECT_LT(fit->points[i].residual_m, fit->points[3].residual_m) << i;
  }
  EXPECT_GT(fit->residual_m, 0.005);
}

TEST(RigidFit, WhatDoesNotSpanAPlaneIsRefused) {
  const auto refused = [](std::vector<AlignedPoint> points, const char* code, const char* path) {
    const auto fit = fit_rigid(std::move(points));
    ASSERT_FALSE(fit);
    EXPECT_EQ(fit.error().code, code);
    EXPECT_EQ(fit.error().path, path);
    EXPECT_FALSE(fit.error().hint.empty());
  };
  refused({}, "invalid_params", "/points");
  refused(touched({{0, 0, 0}, {1, 0, 0}}), "invalid_params", "/points");
  refused(touched({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}}), "invalid_params", "/points");
  refused(touched({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), "invalid_params", "/points");
  auto same_touch = touched({{0, 0, 0}, {0.6, 0, 0}, {0, 0.4, 0}});
  for (AlignedPoint& p : same_touch) p.source = {0.1, 0.1, 0.1};
  refused(same_touch, "invalid_params", "/points");
  auto far = touched({{0, 0, 0}, {0.6, 0, 0}, {0, 0.4, 0}});
  far[1].world.y = 1e300;
  refused(far, "out_of_range", "/points/1/world/1");
  far[1].world.y = std::nan("");
  refused(far, "out_of_range", "/points/1/world/1");
}

}  // namespace
}  // namespace posed::calibration
