#include "server/solver/orientation.h"

#include <gtest/gtest.h>

#include <random>

namespace posed {
namespace {

const Vec3 kLimbs[] = {kY, -kY, kZ, -kZ, kX, -kX, Vec3(0.2, 0, -0.068), Vec3(0.3, -2.0, 1.1), Vec3(1e-3, 1e-3, 0)};

double wrapped(double angle) {
  return std::remainder(angle, 2.0 * M_PI);
}

// 0 for the same rotation, whatever the sign.
double apart(const Quat& a, const Quat& b) {
  return std::min(glm::length(a - b), glm::length(a + b));
}

// The paper's formula, with rotations built from matrices of Rodrigues instead of the product's quaternions.
glm::dmat3 about(const Vec3& axis, double angle) {
  const glm::dmat3 cross(Vec3(0, axis.z, -axis.y), Vec3(-axis.z, 0, axis.x), Vec3(axis.y, -axis.x, 0));
  return glm::dmat3(1.0) + std::sin(angle) * cross + (1.0 - std::cos(angle)) * cross * cross;
}

TEST(OrientationTest, IsThePapersProduct) {
  std::mt19937 random{3};
  std::uniform_real_distribution<double> turn(-M_PI, M_PI), bend(0.0, M_PI);
  for (const Vec3& limb : kLimbs) {
    const Vec3 p = glm::normalize(limb);
    const Vec3 wish = std::abs(p.x) > 1.0 - 1e-9 ? kY : kX;
    const Vec3 q = glm::normalize(wish - p * glm::dot(p, wish));
    for (int i = 0; i < 50; ++i) {
      const Orientation o{turn(random), bend(random), turn(random)};
      const glm::dmat3 expected = about(p, o.halfplane) * about(q, o.deviation) * about(p, o.twist - o.halfplane);
      const glm::dmat3 found = glm::mat3_cast(quat_from_orientation(o, limb));
      for (int k = 0; k < 3; ++k) EXPECT_LT(glm::length(expected[k] - found[k]), 1e-13);
    }
  }
}

TEST(OrientationTest, DeviationIsTheAngleBetweenTheLimbAndItsRest) {
  for (const Vec3& limb : kLimbs) {
    const Vec3 p = glm::normalize(limb);
    const Vec3 now = quat_from_orientation({0.7, 1.1, -2.0}, limb) * p;
    EXPECT_NEAR(std::acos(glm::dot(now, p)), 1.1, 1e-12);
  }
}

TEST(OrientationTest, TwistAloneTurnsAboutTheLimb) {
  const Quat q = quat_from_orientation({0.0, 0.0, 0.5}, kY * 0.3);
  EXPECT_LT(apart(q, quat_about(kY, 0.5)), 1e-15);
}

// The protocol's own example.
TEST(OrientationTest, OfTheLeftElbowTurnsAboutX) {
  const Quat q = quat_from_orientation({0.0, 1.2, 0.0}, Vec3(0, 0.2555, 0));
  EXPECT_LT(apart(q, quat_from_xyzw(std::sin(0.6), 0.0, 0.0, std::cos(0.6))), 1e-15);
}

TEST(OrientationTest, ComesBackFromTheQuaternion) {
  std::mt19937 random{4};
  std::uniform_real_distribution<double> turn(-M_PI, M_PI), bend(1e-3, M_PI - 1e-3);
  for (const Vec3& limb : kLimbs) {
    for (int i = 0; i < 200; ++i) {
      const Orientation o{turn(random), bend(random), turn(random)};
      const Quat quat = quat_from_orientation(o, limb);
      const Orientation back = orientation_from_quat(quat, limb);
      EXPECT_NEAR(wrapped(back.halfplane - o.halfplane), 0.0, 1e-11);
      EXPECT_NEAR(back.deviation, o.deviation, 1e-12);
      EXPECT_NEAR(wrapped(back.twist - o.twist), 0.0, 1e-11);
      const Orientation negated = orientation_from_quat(-quat, limb);
      EXPECT_NEAR(wrapped(negated.halfplane - o.halfplane), 0.0, 1e-11);
      EXPECT_NEAR(negated.deviation, o.deviation, 1e-12);
      EXPECT_NEAR(wrapped(negated.twist - o.twist), 0.0, 1e-11);
    }
  }
}

TEST(OrientationTest, AnyQuaternionComesBackInItsRanges) {
  std::mt19937 random{5};
  std::normal_distribution<double> normal;
  for (const Vec3& limb : kLimbs) {
    for (int i = 0; i < 200; ++i) {
      const Quat quat = glm::normalize(Quat(normal(random), normal(random), normal(random), normal(random)));
      const Orientation o = orientation_from_quat(quat, limb);
      EXPECT_LT(apart(quat_from_orientation(o, limb), quat), 1e-14);
      EXPECT_TRUE(o.deviation >= 0.0 && o.deviation <= M_PI);
      EXPECT_TRUE(o.halfplane > -M_PI && o.halfplane <= M_PI);
      EXPECT_TRUE(o.twist > -M_PI && o.twist <= M_PI);
    }
  }
}

TEST(OrientationTest, WithoutDeviationThereIsNoHalfplane) {
  for (const Vec3& limb : kLimbs) {
    for (const double twist : {0.0, 0.5, -3.0, M_PI}) {
      const Quat quat = quat_from_orientation({1.3, 0.0, twist}, limb);
      for (const Quat& sign : {quat, -quat}) {
        const Orientation o = orientation_from_quat(sign, limb);
        EXPECT_EQ(o.deviation, 0.0);
        EXPECT_EQ(o.halfplane, 0.0);
        EXPECT_NEAR(wrapped(o.twist - twist), 0.0, 1e-12);
      }
    }
  }
}

TEST(OrientationTest, BentRightBackTheHalfplaneIsZeroAndTheRotationStays) {
  for (const Vec3& limb : kLimbs) {
    for (const double halfplane : {0.0, 0.4, -2.5}) {
      for (const double twist : {0.0, 0.9, -2.0}) {
        const Quat quat = quat_from_orientation({halfplane, M_PI, twist}, limb);
        for (const Quat& sign : {quat, -quat}) {
          const Orientation o = orientation_from_quat(sign, limb);
          EXPECT_EQ(o.deviation, M_PI);
          EXPECT_EQ(o.halfplane, 0.0);
          EXPECT_NEAR(wrapped(o.twist - (twist - 2.0 * halfplane)), 0.0, 1e-12);
          EXPECT_LT(apart(quat_from_orientation(o, limb), quat), 1e-14);
        }
      }
    }
  }
}

TEST(OrientationTest, ALimbWithoutLengthPointsAlongZ) {
  const Orientation o{0.3, 0.8, -0.2};
  EXPECT_EQ(quat_from_orientation(o, kZero), quat_from_orientation(o, kZ));
}

}  // namespace
}  // namespace posed
