#include "tests/server/scene/scene_fixture.h"

namespace posed {
namespace {

using GoalEdits = SceneTest;

TEST_F(GoalEdits, WithoutAnIdThePlaceNamesIt) {
  GoalEdit edit = goal_edit("");
  expect_edited("body.right_hand.position", 1, [&] { return scene.set_goal(edit, {}); });
  edit.position = Vec3(0.1, 0.2, 0.3);
  expect_edited("body.right_hand.position", 2, [&] { return scene.set_goal(edit, {}); });
  EXPECT_EQ(scene.goals().size(), 1u);
  EXPECT_EQ(position("body.right_hand.position"), Vec3(0.1, 0.2, 0.3));

  edit.at = Attachment{"right_hand", {}, "fingertip"};
  expect_edited("body.right_hand.fingertip.position", 1, [&] { return scene.set_goal(edit, {}); });
}

TEST_F(GoalEdits, ANewGoalHasTheDefaults) {
  ASSERT_TRUE(scene.set_goal(goal_edit("g1"), {}));
  EXPECT_EQ(goal("g1").weight, 10.0);
  EXPECT_EQ(goal("g1").tolerance.radius, 0.0);
  EXPECT_TRUE(goal("g1").enabled);
  EXPECT_EQ(goal("g1").figure, "body");
}

TEST_F(GoalEdits, OnlyTheNamedFieldsChange) {
  GoalEdit first = goal_edit("g1");
  first.weight = 40.0;
  first.tolerance = 0.01;
  first.enabled = false;
  first.label = std::string("reach");
  first.user = std::string("[1]");
  expect_edited("g1", 1, [&] { return scene.set_goal(first, {}); });
  GoalEdit move;
  move.id = "g1";
  move.position = Vec3(1, 2, 3);
  expect_edited("g1", 2, [&] { return scene.set_goal(move, {}); });
  EXPECT_EQ(position("g1"), Vec3(1, 2, 3));
  EXPECT_EQ(goal("g1").at, *first.at);
  EXPECT_EQ(goal("g1").weight, 40.0);
  EXPECT_EQ(goal("g1").tolerance.radius, 0.01);
  EXPECT_FALSE(goal("g1").enabled);
  EXPECT_EQ(goal("g1").label, "reach");
  EXPECT_EQ(goal("g1").user, "[1]");
}

TEST_F(GoalEdits, NullRestoresTheDefaults) {
  GoalEdit first = goal_edit("g1");
  first.weight = 40.0;
  first.tolerance = 0.01;
  first.enabled = false;
  first.label = std::string("reach");
  first.user = std::string("[1]");
  ASSERT_TRUE(scene.set_goal(first, {}));
  GoalEdit null;
  null.id = "g1";
  null.weight = Patched<GoalWeight>::reset();
  null.tolerance = Patched<GoalTolerance>::reset();
  null.enabled = Patched<bool>::reset();
  null.label = null.user = Patched<std::string>::reset();
  ASSERT_TRUE(scene.set_goal(null, {}));
  EXPECT_EQ(goal("g1").weight, 10.0);
  EXPECT_EQ(goal("g1").tolerance.radius, 0.0);
  EXPECT_TRUE(goal("g1").enabled);
  EXPECT_EQ(goal("g1").label, "");
  EXPECT_EQ(goal("g1").user, "");
}

TEST_F(GoalEdits, ANewGoalNeedsAPlaceAndAPosition) {
  expect_refused("missing_field", "/at", [&] { return scene.set_goal({}, {}); });
  GoalEdit no_place = goal_edit("g1");
  no_place.at.reset();
  expect_refused("missing_field", "/at", [&] { return scene.set_goal(no_place, {}); });
  GoalEdit no_position = goal_edit("g1");
  no_position.position.reset();
  expect_refused("missing_field", "/position", [&] { return scene.set_goal(no_position, {}); });
}

TEST_F(GoalEdits, UnknownNamesAreToldWithTheNearest) {
  const auto typo = scene.set_goal(goal_edit("", "right_hnd"), {});
  ASSERT_FALSE(typo);
  EXPECT_EQ(typo.error().hint, "did you mean right_hand?");
  expect_refused("unknown_segment", "/at", [&] { return scene.set_goal(goal_edit("", "right_hnd"), {}); });
  expect_refused("unknown_segment", "/at", [&] { return scene.set_goal(goal_edit("", "right hand"), {}); });
  GoalEdit site = goal_edit("g1");
  site.at = Attachment{"right_hand", {}, "elbow"};
  expect_refused("unknown_site", "/at", [&] { return scene.set_goal(site, {}); });
  GoalEdit figure = goal_edit("g1");
  figure.figure = "bodi";
  expect_refused("unknown_figure", "/figure", [&] { return scene.set_goal(figure, {}); });
  // Also of a goal that is there already.
  ASSERT_TRUE(scene.set_goal(goal_edit("g1"), {}));
  expect_refused("unknown_segment", "/at", [&] { return scene.set_goal(goal_edit("g1", "wing"), {}); });
  expect_refused("unknown_figure", "/figure", [&] { return scene.set_goal(figure, {}); });
}

TEST_F(GoalEdits, NumbersHaveRanges) {
  expect_refused("bad_id", "/id", [&] { return scene.set_goal(goal_edit("a b"), {}); });
  for (const double bad : {-0.1, 1.1e9, std::nan("")}) {
    GoalEdit edit = goal_edit("g1");
    edit.weight = bad;
    expect_refused("out_of_range", "/weight", [&] { return scene.set_goal(edit, {}); });
  }
  GoalEdit tolerance = goal_edit("g1");
  tolerance.tolerance = -1.0;
  expect_refused("out_of_range", "/tolerance", [&] { return scene.set_goal(tolerance, {}); });
  tolerance.tolerance = GoalTolerance(Vec3(0.1, 0.1, -0.1));
  expect_refused("out_of_range", "/tolerance/2", [&] { return scene.set_goal(tolerance, {}); });
  GoalEdit box;
  box.id = "g2";
  box.at = Attachment{"head", {}, ""};
  box.orientation = OrientationTarget{Quat(1, 0, 0, 0)};
  box.tolerance = GoalTolerance(Vec3(0.1));
  expect_refused("invalid_params", "/tolerance", [&] { return scene.set_goal(box, {}); });
  expect_refused("out_of_range", "/position/1", [&] {
    return scene.set_goal(goal_edit("g1", "head", {0, -2e6, 0}), {});
  });
  GoalEdit zero = goal_edit("g1");
  zero.weight = 0.0;
  EXPECT_TRUE(scene.set_goal(zero, {}));
}

// A point that is no part of any body made the solver's arithmetic overflow.
TEST_F(GoalEdits, ThePointThatIsHeldLiesOnABody) {
  GoalEdit edit = goal_edit("g1");
  edit.at = Attachment{"right_hand", Vec3(0, 0, 1e300), ""};
  expect_refused("out_of_range", "/at/point/2", [&] { return scene.set_goal(edit, {}); });
  edit.at = Attachment{"right_hand", Vec3(0, 0, 3), ""};
  EXPECT_TRUE(scene.set_goal(edit, {}));
}

TEST_F(GoalEdits, ComparesTheGoalsOwnRevision) {
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.set_goal(goal_edit("g1"), 1); });
  expect_edited("g1", 1, [&] { return scene.set_goal(goal_edit("g1"), 0); });
  ASSERT_TRUE(scene.set_goal(goal_edit("g2"), {}));
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.set_goal(goal_edit("g1"), 0); });
  expect_edited("g1", 2, [&] { return scene.set_goal(goal_edit("g1"), nth("g1", 1)); });
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.remove_goal("g1", nth("g1", 1)); });
  expect_edited("g1", 0, [&] { return scene.remove_goal("g1", nth("g1", 2)); });
}

TEST_F(GoalEdits, RemovingAGoalRemovesWhatIsBoundToIt) {
  ASSERT_TRUE(scene.set_goal(goal_edit("g1"), {}));
  ASSERT_TRUE(scene.set_goal(goal_edit("g2", "left_hand"), {}));
  ASSERT_TRUE(scene.set_binding(binding_edit("b1", "g1"), {}));
  ASSERT_TRUE(scene.set_binding(binding_edit("b2", "g2", "simulated:2"), {}));
  expect_edited("g1", 0, [&] { return scene.remove_goal("g1", {}); });
  EXPECT_FALSE(scene.bindings().contains("b1"));
  EXPECT_TRUE(scene.bindings().contains("b2"));
  EXPECT_FALSE(scene.follow(frame({1, 1, 1})));
  expect_refused("unknown_goal", "/id", [&] { return scene.remove_goal("g1", {}); });
}

TEST_F(GoalEdits, ClearCountsOneRevision) {
  ASSERT_TRUE(scene.set_figure(small_entry("other"), {}));
  ASSERT_TRUE(scene.set_goal(goal_edit("g1"), {}));
  ASSERT_TRUE(scene.set_goal(goal_edit("g2", "head"), {}));
  GoalEdit on_other = goal_edit("g3", "tip");
  on_other.figure = "other";
  ASSERT_TRUE(scene.set_goal(on_other, {}));
  ASSERT_TRUE(scene.set_binding(binding_edit("b1", "g1"), {}));
  const Revision before = scene.revision();
  EXPECT_EQ(scene.clear_goals("body"), 2);
  EXPECT_EQ(scene.revision(), before + 1);
  EXPECT_EQ(scene.goals().size(), 1u);
  EXPECT_TRUE(scene.bindings().empty());
  EXPECT_EQ(scene.clear_goals("body"), 0);
  EXPECT_EQ(scene.revision(), before + 1);
  EXPECT_EQ(scene.clear_goals(""), 1);
  EXPECT_TRUE(scene.goals().empty());
}

}  // namespace
}  // namespace posed
