#include "server/solver/simple_chain.h"

#include <gtest/gtest.h>

#include "tests/support/figures.h"

namespace posed {
namespace {

struct Chain {
  std::vector<Vec3> links;  // each in the frame of its joint
  std::vector<ChainJoint> joints;

  // A straight chain along X from the origin.
  explicit Chain(const std::vector<double>& lengths, const Vec3& bend_axis = kZero) {
    for (const double length : lengths) {
      links.push_back(kX * length);
      joints.push_back({kZero, quat_identity(), bend_axis, quat_identity()});
    }
    tip();
  }

  // Places the joints anew and says where the tip is: kinematics written once more, as a check.
  Vec3 tip() {
    Vec3 at = kZero;
    Quat rotation = quat_identity();
    for (std::size_t i = 0; i < joints.size(); ++i) {
      joints[i].origin = at;
      joints[i].world_from_frame = rotation;
      rotation = rotation * joints[i].rotation;
      at += rotation * links[i];
    }
    return at;
  }

  Vec3 solve(const Vec3& target) {
    const Vec3 start = tip();
    const Vec3 said = solve_simple_chain(joints, start, target);
    const Vec3 is = tip();
    EXPECT_LT(glm::length(said - is), 1e-9);
    for (const ChainJoint& j : joints) EXPECT_NEAR(glm::length(j.rotation), 1.0, 1e-12);
    return is;
  }
};

double miss(const Vec3& a, const Vec3& b) {
  return glm::length(a - b);
}

TEST(SimpleChain, ClosesTheTriangle) {
  Chain chain({1.0, 1.0}, kZ);
  EXPECT_LT(miss(chain.solve({0.5, 0.5, 0.7}), {0.5, 0.5, 0.7}), 1e-12);
}

TEST(SimpleChain, StraightensTowardsWhatIsTooFar) {
  Chain chain({1.0, 1.0, 0.5}, kZ);
  chain.solve({0.3, 0.4, 0.0});
  EXPECT_LT(miss(chain.solve({0, 10, 0}), {0, 2.5, 0}), 1e-9);
}

TEST(SimpleChain, FoldsToTheNearestDistance) {
  Chain chain({1.0, 0.3}, kZ);
  EXPECT_LT(miss(chain.solve({0.1, 0.0, 0.0}), {0.7, 0.0, 0.0}), 1e-9);
  EXPECT_LT(miss(chain.solve({0.0, 0.1, 0.0}), {0.0, 0.7, 0.0}), 1e-9);
}

TEST(SimpleChain, BendsFromTheTipAndLeavesTheTrunkAlone) {
  Chain chain({1.0, 0.4, 0.3, 0.2}, kZ);
  const Vec3 target{1.2, 0.4, 0.1};
  EXPECT_LT(miss(chain.solve(target), target), 1e-12);
  EXPECT_EQ(chain.joints[0].rotation, quat_identity());
}

TEST(SimpleChain, AStraightLimbBendsAboutItsBendAxis) {
  Chain chain({1.0, 1.0}, kZ);
  chain.solve({1.5, 0, 0});
  EXPECT_LT(chain.joints[1].origin.y, -0.1);  // a positive turn about Z: the middle goes to -Y
  EXPECT_NEAR(chain.joints[1].origin.z, 0.0, 1e-12);
  Chain other({1.0, 1.0}, -kZ);
  other.solve({1.5, 0, 0});
  EXPECT_GT(other.joints[1].origin.y, 0.1);
}

TEST(SimpleChain, ABentLimbKeepsItsPlane) {
  Chain chain({1.0, 1.0}, kZ);
  chain.joints[1].rotation = quat_about(kY, 0.5);
  chain.solve({1.2, 0, 0});
  EXPECT_NEAR(chain.joints[1].origin.y, 0.0, 1e-12);
}

TEST(SimpleChain, TheBendAxisTurnsWithTheParent) {
  Chain chain({1.0, 1.0, 1.0}, kZ);
  chain.joints[0].rotation = quat_about(kX, M_PI / 2);  // Z of the second joint's frame now points to -Y
  const Vec3 tip = chain.tip();
  chain.solve(tip - kX * 0.2);
  EXPECT_NEAR(chain.joints[2].origin.y, 0.0, 1e-9);
  EXPECT_LT(chain.joints[2].origin.z, -0.1);
}

TEST(SimpleChain, SurvivesLinksOfNoLengthAndExactOpposition) {
  const Vec3 targets[] = {{-2, 0, 0}, {2, 0, 0}, {0, 0, 0}, {-0.5, 0, 0}, {1e6, -1e6, 1e6}};
  for (const Vec3& target : targets) {
    for (const auto& lengths : std::vector<std::vector<double>>{{1, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 0}, {0, 0}, {1}}) {
      Chain a(lengths), b(lengths);
      double length = 0.0;
      for (const double l : lengths) length += l;
      const Vec3 tip = a.solve(target);
      EXPECT_TRUE(finite(tip));
      EXPECT_EQ(tip, b.solve(target));
      if (lengths.size() > 1 && length == 2.0) {
        const double reachable = std::min(glm::length(target), 2.0);
        EXPECT_NEAR(glm::length(tip), reachable, 1e-8) << lengths.size() << " " << target.x;
      }
    }
  }
}

TEST(SimpleChain, ReachesTheNearestDistanceOfAnyTwoLinks) {
  std::mt19937 random(7);
  for (int n = 0; n < 2000; ++n) {
    const double a = test::uniform(random, 0.05, 1.0), b = test::uniform(random, 0.05, 1.0);
    Chain chain({a, b}, kY);
    chain.joints[1].rotation = quat_about(kZ, test::uniform(random, -3, 3));
    const Vec3 target = test::random_point(random, 1.5);
    const double d = glm::length(target);
    const double nearest = std::max({0.0, d - a - b, std::abs(a - b) - d});
    EXPECT_NEAR(miss(chain.solve(target), target), nearest, 1e-9);
  }
}

TEST(SimpleChain, ALongerChainStretchesOutTowardsWhatIsBeyondIt) {
  std::mt19937 random(8);
  for (int n = 0; n < 2000; ++n) {
    std::vector<double> lengths;
    double length = 0.0;
    for (int k = 3 + test::pick(random, 4); k > 0; --k) {
      lengths.push_back(test::uniform(random, 0.1, 0.5));
      length += lengths.back();
    }
    Chain chain(lengths, kZ);
    for (ChainJoint& j : chain.joints) j.rotation = quat_about(glm::normalize(test::random_point(random, 1.0)), 1.0);
    const Vec3 target = test::random_point(random, 2.0);
    const double d = glm::length(target);
    const double off = miss(chain.solve(target), target);
    if (d >= length) {
      EXPECT_NEAR(off, d - length, 1e-9);
    }
  }
}

}  // namespace
}  // namespace posed
