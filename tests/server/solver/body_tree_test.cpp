#include "server/solver/body_tree.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "server/solver/figure_check.h"
#include "tests/support/figures.h"

namespace posed {
namespace {

using test::column;

TEST(BodyTree, KeepsTheDocumentsOrderAndIndexesIt) {
  FigureDocument d = column(3, 1.0);
  d.aliases = {{"tip", "s2"}};
  d.sites = {{"s2/end", {"s2", {0, 0, 2}}}, {"bare", {"s1", {1, 0, 0}}}};
  const auto tree = test::build(d);
  EXPECT_EQ(tree->size(), 3);
  EXPECT_EQ(tree->parent(0), -1);
  EXPECT_EQ(tree->parent(2), 1);
  EXPECT_EQ(tree->q_at(0), 0);
  EXPECT_EQ(tree->q_at(1), 7);
  EXPECT_EQ(tree->q_at(2), 11);
  EXPECT_EQ(tree->q_size(), 15);
  EXPECT_EQ(tree->dof(), 12);
  EXPECT_EQ(tree->find_segment("s1"), 1);
  EXPECT_EQ(tree->find_segment("tip"), 2);
  EXPECT_EQ(tree->find_segment("j1"), std::nullopt);
  EXPECT_EQ(tree->find_joint("j1"), 1);
  EXPECT_TRUE(tree->root_is_free());
}

TEST(BodyTree, FindsWhereAGoalTakesHold) {
  FigureDocument d = column(3, 1.0);
  d.aliases = {{"tip", "s2"}};
  d.sites = {{"s2/end", {"s2", {0, 0, 2}}}, {"bare", {"s1", {1, 0, 0}}}};
  const auto tree = test::build(d);
  EXPECT_EQ(tree->attach({"s1", {}, ""})->point, Vec3(0, 0, 1));
  EXPECT_EQ(tree->attach({"s1", Vec3(1, 2, 3), ""})->point, Vec3(1, 2, 3));
  EXPECT_EQ(tree->attach({"s2", {}, "end"})->point, Vec3(0, 0, 2));
  EXPECT_EQ(tree->attach({"tip", {}, "end"})->segment, 2);
  EXPECT_EQ(tree->attach({"", {}, "s2/end"})->segment, 2);
  EXPECT_EQ(tree->attach({"", {}, "bare"})->point, Vec3(1, 0, 0));

  const auto segment = tree->attach({"s22", {}, ""});
  EXPECT_EQ(segment.error().code, "unknown_segment");
  EXPECT_EQ(segment.error().hint, "did you mean s2?");
  const auto site = tree->attach({"s2", {}, "ent"});
  EXPECT_EQ(site.error().code, "unknown_site");
  EXPECT_EQ(site.error().hint, "did you mean s2/end?");
}

TEST(BodyTree, NormalisesWhatIsUnitToAMillionth) {
  FigureDocument d = column(2, 1.0);
  d.segments[1].joint.parent_from_joint.rotation = Quat(1.0 + 5e-7, 0, 0, 0);
  const auto tree = test::build(d);
  EXPECT_EQ(tree->joint(1).parent_from_joint.rotation.w, 1.0);
}

TEST(BodyTree, RestOfAFreeRootIsItsPlaceInTheWorld) {
  FigureDocument d = column(2, 1.0);
  d.segments[0].joint.parent_from_joint = {{1, 2, 3}, quat_about(kZ, M_PI / 2)};
  const std::vector<double> rest = test::build(d)->rest();
  EXPECT_EQ(rest[0], 1.0);
  EXPECT_EQ(rest[2], 3.0);
  EXPECT_NEAR(rest[5], std::sqrt(0.5), 1e-12);
  EXPECT_EQ(rest[10], 1.0);
}

TEST(BodyTree, NormalisesSwing) {
  FigureDocument d = column(3, 1.0);
  d.segments[1].joint.swing = Swing{Swing::Kind::ellipse, kZ * (1.0 + 5e-7), {0.8, 0.5}, {}};
  d.segments[1].joint.twist = Limit{-M_PI, M_PI};
  d.segments[2].joint.swing = Swing{Swing::Kind::polygon, kZero, {}, {kX, kY * (1.0 - 5e-7), kZ}};
  const auto tree = test::build(d);
  EXPECT_EQ(tree->joint(1).swing->center, kZ);
  EXPECT_NEAR(tree->joint(2).swing->corners[1].y, 1.0, 1e-15);
}

Swing ellipse(double a, double b) {
  return Swing{Swing::Kind::ellipse, kZero, {a, b}, {}};
}
Swing polygon(std::vector<Vec3> corners) {
  return Swing{Swing::Kind::polygon, kZero, {}, std::move(corners)};
}

struct BadFigure {
  const char* what;
  const char* path;
  std::function<void(FigureDocument&)> spoil;
};

class BodyTreeRefuses : public testing::TestWithParam<BadFigure> {};

TEST_P(BodyTreeRefuses, WithThePathAndACure) {
  FigureDocument d = column(4, 1.0);
  GetParam().spoil(d);
  const auto tree = BodyTree::build(d);
  ASSERT_FALSE(tree) << GetParam().what;
  EXPECT_EQ(tree.error().code, "bad_figure");
  EXPECT_EQ(tree.error().path, GetParam().path) << tree.error().message;
  EXPECT_FALSE(tree.error().message.empty());
  EXPECT_FALSE(tree.error().hint.empty()) << tree.error().message;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const BadFigure kBadFigures[] = {
    {"no segments", "/segments", [](auto& d) { d.segments.clear(); }},
    {"too many", "/segments", [](auto& d) { d = column(kMaxSegments + 1, 1.0); }},
    {"a name of nothing", "/segments/2/name", [](auto& d) { d.segments[2].name = ""; }},
    {"a name with a slash", "/segments/2/name", [](auto& d) { d.segments[2].name = "a/b"; }},
    {"a name twice", "/segments/2/name", [](auto& d) { d.segments[2].name = "s1"; }},
    {"a joint's name twice", "/segments/2/joint/name", [](auto& d) { d.segments[2].joint.name = "j0"; }},
    {"an unknown parent", "/segments/2/parent", [](auto& d) { d.segments[2].parent = "s9"; }},
    {"a child before its parent", "/segments/1/parent", [](auto& d) { d.segments[1].parent = "s2"; }},
    {"its own parent", "/segments/2/parent", [](auto& d) { d.segments[2].parent = "s2"; }},
    {"two roots", "/segments/3/parent", [](auto& d) { d.segments[3].parent = ""; }},
    {"no root", "/segments/0/parent", [](auto& d) { d.segments[0].parent = "s3"; }},
    {"another root named", "/root", [](auto& d) { d.root = "s1"; }},
    {"a free joint inside", "/segments/3/joint/type", [](auto& d) { d.segments[3].joint.type = JointType::free; }},
    {"a position of nan", "/segments/1/joint/position",
     [](auto& d) { d.segments[1].joint.parent_from_joint.position.y = kNan; }},
    {"a quaternion not unit", "/segments/1/joint/quat_xyzw",
     [](auto& d) { d.segments[1].joint.parent_from_joint.rotation = Quat(1.0 + 2e-6, 0, 0, 0); }},
    {"a quaternion of nan", "/segments/1/joint/quat_xyzw",
     [](auto& d) { d.segments[1].joint.parent_from_joint.rotation.x = kNan; }},
    {"a hinge without axis", "/segments/1/joint/axes", [](auto& d) { d.segments[1].joint.type = JointType::hinge; }},
    {"a ball with an axis", "/segments/1/joint/axes", [](auto& d) { d.segments[1].joint.axes = {kX}; }},
    {"an axis not unit", "/segments/1/joint/axes/0",
     [](auto& d) { d.segments[1].joint.type = JointType::hinge, d.segments[1].joint.axes = {kX * 2.0}; }},
    {"parallel axes", "/segments/1/joint/axes",
     [](auto& d) {
       d.segments[1].joint.type = JointType::universal, d.segments[1].joint.axes = {kX, -kX};
     }},
    {"a bend axis not unit", "/segments/1/joint/bend_axis", [](auto& d) { d.segments[1].joint.bend_axis = kX * 0.5; }},
    {"two limits of three", "/segments/3/joint/limits",
     [](auto& d) {
       d.segments[3].joint.limits = {Limit{0, 1}, Limit{0, 1}};
     }},
    {"a limit the wrong way round", "/segments/3/joint/limits/0",
     [](auto& d) {
       d.segments[3].joint.limits = {Limit{1, 0}, std::nullopt, std::nullopt};
     }},
    {"a limit of nan", "/segments/3/joint/limits/2",
     [](auto& d) {
       d.segments[3].joint.limits = {std::nullopt, std::nullopt, Limit{0, kNan}};
     }},
    {"swing of a universal joint", "/segments/2/joint/swing",
     [](auto& d) {
       d.segments[2].joint.type = JointType::universal, d.segments[2].joint.axes = {kX, kY},
       d.segments[2].joint.swing = ellipse(1, 1);
     }},
    {"twist of the root", "/segments/0/joint/twist",
     [](auto& d) {
       d.segments[0].joint.twist = Limit{0, 1};
     }},
    {"swing and limits", "/segments/2/joint/swing",
     [](auto& d) { d.segments[2].joint.swing = ellipse(1, 1), d.segments[2].joint.limits.resize(3); }},
    {"a swing radius of nothing", "/segments/2/joint/swing/ellipse/1",
     [](auto& d) { d.segments[2].joint.swing = ellipse(1, 0); }},
    {"a swing radius of half a turn", "/segments/2/joint/swing/ellipse/0",
     [](auto& d) { d.segments[2].joint.swing = ellipse(M_PI, 1); }},
    {"a swing radius of nan", "/segments/2/joint/swing/ellipse/0",
     [](auto& d) { d.segments[2].joint.swing = ellipse(kNan, 1); }},
    {"a swing centre not unit", "/segments/2/joint/swing/center",
     [](auto& d) { d.segments[2].joint.swing = ellipse(1, 1), d.segments[2].joint.swing->center = kX * 2.0; }},
    {"a polygon of two", "/segments/2/joint/swing/polygon",
     [](auto& d) {
       d.segments[2].joint.swing = polygon({kX, kY});
     }},
    {"a corner not unit", "/segments/2/joint/swing/polygon/1",
     [](auto& d) {
       d.segments[2].joint.swing = polygon({kX, kY * 1.1, kZ});
     }},
    {"a clockwise polygon", "/segments/2/joint/swing/polygon/2",
     [](auto& d) {
       d.segments[2].joint.swing = polygon({kX, kZ, kY});
     }},
    {"a corner twice", "/segments/2/joint/swing/polygon/2",
     [](auto& d) {
       d.segments[2].joint.swing = polygon({kX, kY, kY, kZ});
     }},
    {"a dent", "/segments/2/joint/swing/polygon/3",
     [](auto& d) {
       d.segments[2].joint.swing = polygon({kX, kY, glm::normalize(Vec3(1, 1, 1)), kZ});
     }},
    {"a twist beyond a turn", "/segments/2/joint/twist",
     [](auto& d) {
       d.segments[2].joint.twist = Limit{-4, 0};
     }},
    {"a twist the wrong way round", "/segments/2/joint/twist",
     [](auto& d) {
       d.segments[2].joint.twist = Limit{1, 0};
     }},
    {"a touch point of nan", "/segments/2/touch_point", [](auto& d) { d.segments[2].touch_point.x = kNan; }},
    {"a touch point far off", "/segments/2/touch_point", [](auto& d) { d.segments[2].touch_point.x = 1e300; }},
    {"a shape's radius below zero", "/segments/2/shape/0", [](auto& d) { d.segments[2].shapes = {{.radius = -1}}; }},
    {"mass below zero", "/segments/2/mass", [](auto& d) { d.segments[2].mass = -1; }},
    {"a lever of nothing", "/lever", [](auto& d) { d.lever = 0; }},
    {"a site of nobody", "/sites/s9~1x/segment",
     [](auto& d) {
       d.sites["s9/x"] = {"s9", kZero};
     }},
    {"a site under another's name", "/sites/s1~1x",
     [](auto& d) {
       d.sites["s1/x"] = {"s2", kZero};
     }},
    {"a site of nan", "/sites/s1~1x/point",
     [](auto& d) {
       d.sites["s1/x"] = {"s1", {0, kNan, 0}};
     }},
    {"a mirror of nobody", "/mirror/0/1",
     [](auto& d) {
       d.mirror = {{"s1", "s9"}};
     }},
    {"mirrored twice", "/mirror/1",
     [](auto& d) {
       d.mirror = {{"s1", "s2"}, {"s3", "s2"}};
     }},
    {"an alias of nobody", "/aliases/tip", [](auto& d) { d.aliases["tip"] = "s9"; }},
    {"an alias that is a name", "/aliases/s1", [](auto& d) { d.aliases["s1"] = "s2"; }},
};

INSTANTIATE_TEST_SUITE_P(Each, BodyTreeRefuses, testing::ValuesIn(kBadFigures));

TEST(BodyTree, NamesTheThingAndTheNearestName) {
  FigureDocument d = column(3, 1.0);
  d.segments[2].parent = "s10";
  const Error error = BodyTree::build(d).error();
  EXPECT_EQ(error.message, "no segment is called s10, the parent of s2");
  EXPECT_EQ(error.hint, "did you mean s0?");
}

}  // namespace
}  // namespace posed
