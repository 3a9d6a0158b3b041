#include "server/scene/mirror.h"

#include <random>

#include "server/solver/kinematics.h"
#include "tests/server/scene/scene_fixture.h"

namespace posed {
namespace {

class Mirror : public ::testing::Test {
 protected:
  std::vector<double> random_q() {
    std::vector<double> q = tree.rest();
    for (double& value : q) value = normal(random);
    q[1] = 0.0;  // the mirror is the figure's own plane, so the root does not leave it
    normalise_quaternions(tree, q);
    return q;
  }
  std::vector<Transform> world(const std::vector<double>& q) const {
    std::vector<Transform> out(static_cast<std::size_t>(tree.size()));
    forward_kinematics(tree, q, out);
    return out;
  }
  static std::string other_side(const std::string& name) {
    if (name.starts_with("left_")) return "right_" + name.substr(5);
    if (name.starts_with("right_")) return "left_" + name.substr(6);
    return name;
  }

  BodyTree tree = *BodyTree::build(*tempus(1.75));
  std::mt19937 random{8};
  std::normal_distribution<double> normal;
};

TEST_F(Mirror, TwiceIsTheIdentity) {
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> q = random_q();
    EXPECT_EQ(mirrored(tree, mirrored(tree, q)), q);
    EXPECT_NE(mirrored(tree, q), q);
  }
}

TEST_F(Mirror, ShowsTheWorldPoseAcrossY) {
  const auto across = [](Vec3 p) { return Vec3(p.x, -p.y, p.z); };
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> q = random_q();
    const std::vector<Transform> before = world(q), after = world(mirrored(tree, q));
    for (int s = 0; s < tree.size(); ++s) {
      const auto other = static_cast<std::size_t>(*tree.find_segment(other_side(tree.segment(s).name)));
      const Transform &a = before[static_cast<std::size_t>(s)], &b = after[other];
      EXPECT_LT(glm::length(across(a.position) - b.position), 1e-13) << tree.segment(s).name;
      // Any point of the segment, not only its origin.
      const Vec3 point(0.1, -0.2, 0.3);
      EXPECT_LT(glm::length(across(a * point) - b * across(point)), 1e-13) << tree.segment(s).name;
    }
  }
}

TEST_F(Mirror, TheStartPoseIsItsOwnImage) {
  const std::vector<double> q = start_pose(tree), image = mirrored(tree, q);
  for (std::size_t k = 0; k < q.size(); ++k) EXPECT_NEAR(image[k], q[k], 1e-15) << k;
}

TEST_F(Mirror, TheRootKeepsItsPosition) {
  std::vector<double> q = random_q();
  q[1] = 2.0;
  const std::vector<double> image = mirrored(tree, q);
  EXPECT_EQ(image[0], q[0]);
  EXPECT_EQ(image[1], 2.0);
  EXPECT_EQ(image[2], q[2]);
}

}  // namespace
}  // namespace posed
