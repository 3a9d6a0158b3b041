#include "common/math.h"

#include <gtest/gtest.h>

#include <random>

namespace posed {
namespace {

class Math : public ::testing::Test {
 protected:
  double number() { return normal_(random_); }
  Vec3 vec3() { return {number(), number(), number()}; }
  Quat quat() { return glm::normalize(Quat(number(), number(), number(), number())); }

  std::mt19937 random_{1987};
  std::normal_distribution<double> normal_;
};

double distance(const Vec3& a, const Vec3& b) {
  return glm::length(a - b);
}

TEST_F(Math, QuaternionsKeepTheOrderOfTheWire) {
  const Quat q = quat_from_xyzw(0.1, 0.2, 0.3, 0.4);
  EXPECT_EQ(q.x, 0.1);
  EXPECT_EQ(q.w, 0.4);
  const std::array<double, 4> v = xyzw(q);
  EXPECT_EQ(v, (std::array{0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(quat_from_xyzw(v), q);
}

TEST_F(Math, QuatAboutTurnsRightHanded) {
  EXPECT_LT(distance(quat_about(kZ, M_PI / 2) * kX, kY), 1e-15);
  EXPECT_LT(distance(quat_about(kX, M_PI / 2) * kY, kZ), 1e-15);
  EXPECT_LT(distance(quat_about(kY, M_PI / 2) * kZ, kX), 1e-15);
}

TEST_F(Math, ProductOfTransformsIsOneAfterTheOther) {
  for (int i = 0; i < 100; ++i) {
    const Transform a{vec3(), quat()}, b{vec3(), quat()};
    const Vec3 p = vec3();
    EXPECT_LT(distance((a * b) * p, a * (b * p)), 1e-13);
    EXPECT_LT(distance(inverse(a) * (a * p), p), 1e-13);
  }
}

TEST_F(Math, FiniteLooksAtEveryPart) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(finite(Vec3(1, 2, 3)));
  for (int i = 0; i < 3; ++i) {
    Vec3 v(1, 2, 3);
    v[i] = nan;
    EXPECT_FALSE(finite(v)) << i;
    v[i] = -inf;
    EXPECT_FALSE(finite(v)) << i;
  }
  EXPECT_TRUE(finite(quat_identity()));
  EXPECT_FALSE(finite(quat_from_xyzw(0, 0, 0, nan)));
  EXPECT_FALSE(finite(quat_from_xyzw(inf, 0, 0, 1)));
}

TEST_F(Math, SameSignTakesTheNearerOfTheTwo) {
  for (int i = 0; i < 100; ++i) {
    const Quat a = quat(), b = quat(), c = same_sign(a, b);
    EXPECT_GE(glm::dot(a, c), 0.0);
    EXPECT_TRUE(c == b || c == -b);
  }
}

TEST_F(Math, PerpendicularIsUnitAndNearestToTheWish) {
  for (int i = 0; i < 100; ++i) {
    const Vec3 v = vec3(), wish = vec3(), p = perpendicular(v, wish);
    EXPECT_NEAR(glm::length(p), 1.0, 1e-14);
    EXPECT_NEAR(glm::dot(p, glm::normalize(v)), 0.0, 1e-14);
    // Nearest: nothing of the wish is left outside the plane of v and p.
    EXPECT_NEAR(glm::dot(wish, glm::cross(glm::normalize(v), p)), 0.0, 1e-13);
    EXPECT_GT(glm::dot(wish, p), 0.0);
  }
}

TEST_F(Math, PerpendicularToAParallelWishIsStillOne) {
  for (const Vec3& v : {kX, kY, kZ, Vec3(1, 1, 1), Vec3(-2, 0.5, 3)}) {
    for (const double scale : {1.0, -1.0, 1e-9, 1e9}) {
      const Vec3 p = perpendicular(v, v * scale);
      EXPECT_NEAR(glm::length(p), 1.0, 1e-14);
      EXPECT_NEAR(glm::dot(p, glm::normalize(v)), 0.0, 1e-14);
      EXPECT_EQ(p, perpendicular(v, v * scale));
    }
  }
  EXPECT_NEAR(glm::length(perpendicular(kZ, kZero)), 1.0, 1e-15);
  EXPECT_EQ(perpendicular(kZero, Vec3(0, 3, 0)), kY);
  EXPECT_EQ(perpendicular(kZero, kZero), kX);
}

}  // namespace
}  // namespace posed
