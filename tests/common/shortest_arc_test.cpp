#include <gtest/gtest.h>

#include <random>

#include "common/math.h"

namespace posed {
namespace {

double angle_of(const Quat& q) {
  return 2.0 * std::atan2(std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z), std::abs(q.w));
}

TEST(ShortestArc, TakesOneDirectionToTheOtherWithoutATwist) {
  std::mt19937 random{12};
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 from{normal(random), normal(random), normal(random)}, to{normal(random), normal(random), normal(random)};
    const Quat q = shortest_arc(from, to, kX);
    const Vec3 u = glm::normalize(from), v = glm::normalize(to);
    EXPECT_NEAR(glm::length(q), 1.0, 1e-15);
    EXPECT_LT(glm::length(q * u - v), 1e-13);
    EXPECT_NEAR(angle_of(q), std::acos(glm::dot(u, v)), 1e-7);
    // The axis of the smallest rotation is perpendicular to both.
    EXPECT_NEAR(glm::dot(Vec3(q.x, q.y, q.z), u), 0.0, 1e-14);
  }
}

TEST(ShortestArc, IsExactForTinyAngles) {
  for (const double angle : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Quat q = shortest_arc(kX, Vec3(std::cos(angle), std::sin(angle), 0.0), kZ);
    EXPECT_NEAR(q.z / (0.5 * angle), 1.0, 1e-6) << angle;
    EXPECT_EQ(q.x, 0.0);
    EXPECT_EQ(q.y, 0.0);
  }
  EXPECT_EQ(shortest_arc(Vec3(0.3, -2, 1), Vec3(0.3, -2, 1), kX), quat_identity());
}

TEST(ShortestArc, TurnsAboutTheFallbackWhereOpposite) {
  const Quat about_z = shortest_arc(kX, -kX, kZ);
  EXPECT_LT(glm::length(about_z * kX + kX), 1e-15);
  EXPECT_NEAR(std::abs(about_z.z), 1.0, 1e-15);
  // Made perpendicular where it leans.
  const Quat leaning = shortest_arc(kX, -2.0 * kX, Vec3(5, 0, 1));
  EXPECT_NEAR(std::abs(leaning.z), 1.0, 1e-15);
  // And any axis where it can't be.
  for (const Vec3& useless : {kX, -kX, kZero}) {
    const Quat q = shortest_arc(kX, -kX, useless);
    EXPECT_LT(glm::length(q * kX + kX), 1e-15);
    EXPECT_NEAR(glm::length(q), 1.0, 1e-15);
  }
}

TEST(ShortestArc, IsGoodAllTheWayToOpposite) {
  for (const double short_of_pi : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-14}) {
    const double angle = M_PI - short_of_pi;
    const Vec3 to(std::cos(angle), std::sin(angle), 0.0);
    EXPECT_LT(glm::length(shortest_arc(kX, to, kZ) * kX - to), 1e-7) << short_of_pi;
  }
}

TEST(ShortestArc, DoesNotCareAboutLengths) {
  const Quat q = shortest_arc(kX, kY, kZ);
  for (const double scale : {1e-60, 1e-20, 1e-6, 1e6, 1e60}) {
    const Quat scaled = shortest_arc(kX * scale, kY * scale, kZ);
    EXPECT_LT(glm::length(q - scaled), 1e-15) << scale;
  }
}

TEST(ShortestArc, OfNothingIsTheIdentity) {
  EXPECT_EQ(shortest_arc(kZero, kX, kZ), quat_identity());
  EXPECT_EQ(shortest_arc(kX, kZero, kZ), quat_identity());
  EXPECT_EQ(shortest_arc(kZero, kZero, kZ), quat_identity());
}

}  // namespace
}  // namespace posed
