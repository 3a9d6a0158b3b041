#include "server/solver/tempus.h"
#include "server/solver/springs/swing.h"

#include <gtest/gtest.h>

#include "server/solver/kinematics.h"
#include "tests/support/figures.h"

namespace posed {
namespace {

std::vector<Transform> place(const BodyTree& tree, const std::vector<double>& q) {
  std::vector<Transform> world(static_cast<std::size_t>(tree.size()));
  forward_kinematics(tree, q, world);
  return world;
}

Vec3 touch(const BodyTree& tree, const std::vector<Transform>& world, const char* name) {
  const int i = tree.find_segment(name).value();
  return world[static_cast<std::size_t>(i)] * tree.segment(i).touch_point;
}

// Turns a joint by 0.5 rad about its bend axis and says where the touch point of `name` goes.
Vec3 bent(const BodyTree& tree, const char* joint, const char* name) {
  auto q = tree.rest();
  const Vec3 before = touch(tree, place(tree, q), name);
  const int i = tree.find_joint(joint).value();
  const auto turn = xyzw(quat_about(tree.joint(i).bend_axis, 0.5));
  std::copy(turn.begin(), turn.end(), q.begin() + tree.q_at(i));
  return touch(tree, place(tree, q), name) - before;
}

TEST(Tempus, IsThePapersFigure) {
  const auto tree = test::human();
  EXPECT_EQ(tree->size(), 18);
  EXPECT_EQ(tree->dof(), 48);
  EXPECT_EQ(tree->q_size(), 75);
  EXPECT_EQ(tree->document().root, "lower_torso");
}

TEST(Tempus, StandsOnTheFloorAsTallAsItShould) {
  for (const double stature : {0.5, 1.6, 2.5}) {
    const auto tree = test::human(stature);
    const auto world = place(*tree, tree->rest());
    EXPECT_NEAR(touch(*tree, world, "head").z, stature, 1e-12);
    EXPECT_NEAR(touch(*tree, world, "left_foot").z, 0.0, 1e-12);
    EXPECT_NEAR(touch(*tree, world, "right_clavicle").z, 0.815 * stature, 1e-12);
    const auto eyes = tree->attach({"head", {}, "eyes"}).value();
    EXPECT_NEAR((world[static_cast<std::size_t>(eyes.segment)] * eyes.point).z, 0.936 * stature, 1e-12);
  }
}

TEST(Tempus, RefusesAStatureNobodyHas) {
  EXPECT_EQ(tempus(0.49).error().code, "out_of_range");
  EXPECT_EQ(tempus(3.0).error().path, "/stature");
  EXPECT_FALSE(tempus(std::nan("")));
}

TEST(Tempus, WeighsWhatItShould) {
  const FigureDocument d = tempus(1.75).value();
  double mass = 0.0;
  for (const Segment& s : d.segments) mass += s.mass;
  EXPECT_NEAR(mass, 70.0, 1e-9);
}

TEST(Tempus, IsTheSameOnBothSides) {
  const auto tree = test::human();
  const auto world = place(*tree, tree->rest());
  EXPECT_EQ(tree->document().mirror.size(), 7u);
  for (const auto& [left, right] : tree->document().mirror) {
    const Vec3 l = touch(*tree, world, left.c_str()), r = touch(*tree, world, right.c_str());
    EXPECT_NEAR(glm::length(Vec3(l.x, -l.y, l.z) - r), 0.0, 1e-12) << left;
    const auto& a = tree->joint(*tree->find_segment(left)).limits;
    const auto& b = tree->joint(*tree->find_segment(right)).limits;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      if (!a[k]) continue;
      EXPECT_NEAR(a[k]->max - a[k]->min, b[k]->max - b[k]->min, 1e-12) << left;
    }
    const Joint &l_joint = tree->joint(*tree->find_segment(left)), &r_joint = tree->joint(*tree->find_segment(right));
    ASSERT_EQ(l_joint.swing.has_value(), r_joint.swing.has_value());
    if (!l_joint.swing) continue;
    EXPECT_EQ(r_joint.swing->center, l_joint.swing->center * Vec3(1, -1, 1)) << left;
    EXPECT_EQ(r_joint.swing->radii, l_joint.swing->radii) << left;
    EXPECT_EQ(r_joint.twist->min, -l_joint.twist->max) << left;
    EXPECT_EQ(r_joint.twist->max, -l_joint.twist->min) << left;
  }
}

// Where a person's upper arms and thighs can point and where they can not, with the girdle at rest.
TEST(Tempus, ShouldersAndHipsPointWhereAPersonsDo) {
  const auto tree = test::human();
  const auto points = [&](const char* joint, const Vec3& way) {
    const int i = *tree->find_joint(joint);
    springs::Link link;
    springs::make_limb(glm::normalize(tree->segment(i).touch_point), tree->joint(i).swing, link);
    const Vec3 d = glm::normalize(way);
    return glm::length(springs::inside_swing(link, d) - d) < 1e-9;
  };
  for (const Vec3& way : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0.4, 0.1, 0.9), Vec3(1, -0.6, 0),
                          Vec3(-0.6, 0, -0.8), Vec3(-0.5, 1, 0), Vec3(0.3, -0.4, -0.9)}) {
    EXPECT_TRUE(points("left_shoulder", way)) << way.x << " " << way.y << " " << way.z;
    EXPECT_TRUE(points("right_shoulder", way * Vec3(1, -1, 1)));
  }
  for (const Vec3& way : {Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(-0.5, -0.5, 0.5), Vec3(-0.7, 0, 0.7)}) {
    EXPECT_FALSE(points("left_shoulder", way)) << way.x << " " << way.y << " " << way.z;
    EXPECT_FALSE(points("right_shoulder", way * Vec3(1, -1, 1)));
  }
  for (const Vec3& way : {Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0.85, 0.1, 0.4), Vec3(-0.4, 0.1, -0.9),
                          Vec3(0, 0.5, -0.86), Vec3(0, -0.25, -0.97)}) {
    EXPECT_TRUE(points("left_hip", way)) << way.x << " " << way.y << " " << way.z;
    EXPECT_TRUE(points("right_hip", way * Vec3(1, -1, 1)));
  }
  for (const Vec3& way : {Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(-0.7, 0, -0.7)}) {
    EXPECT_FALSE(points("left_hip", way)) << way.x << " " << way.y << " " << way.z;
    EXPECT_FALSE(points("right_hip", way * Vec3(1, -1, 1)));
  }
}

TEST(Tempus, LimbsBendTheWayLimbsDo) {
  const auto tree = test::human();
  for (const std::string side : {"left", "right"}) {
    EXPECT_GT(bent(*tree, (side + "_elbow").c_str(), (side + "_hand").c_str()).x, 0.1);
    EXPECT_GT(bent(*tree, (side + "_shoulder").c_str(), (side + "_hand").c_str()).x, 0.1);
    EXPECT_LT(bent(*tree, (side + "_knee").c_str(), (side + "_lower_leg").c_str()).x, -0.1);
    EXPECT_GT(bent(*tree, (side + "_hip").c_str(), (side + "_upper_leg").c_str()).x, 0.1);
    EXPECT_LT(bent(*tree, (side + "_wrist").c_str(), (side + "_hand").c_str()).z, -0.01);
    EXPECT_GT(bent(*tree, (side + "_ankle").c_str(), (side + "_foot").c_str()).z, 0.01);
  }
  EXPECT_GT(bent(*tree, "waist", "upper_torso").x, 0.1);
  EXPECT_GT(bent(*tree, "head", "head").x, 0.05);
}

TEST(Tempus, StartsWithTheArmsDown) {
  const auto tree = test::human();
  const auto q = start_pose(*tree);
  EXPECT_TRUE(check_q(*tree, q));
  const auto world = place(*tree, q);
  for (const char* hand : {"left_hand", "right_hand"}) {
    const Vec3 palm = touch(*tree, world, hand);
    EXPECT_LT(palm.z, 0.46 * 1.75);
    EXPECT_NEAR(palm.x, 0.0, 1e-12);
    EXPECT_GT(std::abs(palm.y), 0.25);
  }
  const auto other = test::build(test::column(2, 1.0));
  EXPECT_EQ(start_pose(*other), other->rest());
}

TEST(Tempus, AnswersToTheNamesOfVrm) {
  const auto tree = test::human();
  EXPECT_EQ(tree->find_segment("hips"), 0);
  EXPECT_EQ(tree->find_segment("leftUpperArm"), tree->find_segment("left_upper_arm"));
  EXPECT_EQ(tree->find_segment("rightFoot"), tree->find_segment("right_foot"));
  EXPECT_TRUE(tree->attach({"right_hand", {}, "fingertip"}));
  EXPECT_TRUE(tree->attach({"left_foot", {}, "heel"}));
}

}  // namespace
}  // namespace posed
