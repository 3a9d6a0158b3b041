#include "tests/server/scene/scene_fixture.h"

namespace posed {
namespace {

using FigureEdits = SceneTest;

TEST_F(FigureEdits, ATemplateStandsInItsStartPose) {
  const SceneFigure& body = scene.figures().at("body");
  EXPECT_EQ(body.tree->size(), 18);
  EXPECT_EQ(body.tree->dof(), 48);
  EXPECT_EQ(body.q, start_pose(*body.tree));
  EXPECT_TRUE(body.entry.q.empty());
}

TEST_F(FigureEdits, SetCreatesAndChanges) {
  expect_edited("other", 1, [&] { return scene.set_figure(small_entry("other"), {}); });
  expect_edited("other", 2, [&] { return scene.set_figure(tempus_entry("other", 1.9), {}); });
  EXPECT_EQ(scene.figures().at("other").entry.stature, 1.9);
}

TEST_F(FigureEdits, AnotherStatureKeepsPoseGoalsAndBindings) {
  ASSERT_TRUE(scene.set_goal(goal_edit("g1"), {}));
  ASSERT_TRUE(scene.set_binding(binding_edit("b1", "g1"), {}));
  std::vector<double> q = scene.figures().at("body").q;
  q[0] = 0.25;
  ASSERT_TRUE(scene.set_q("body", q, {}));
  ASSERT_NE(q, start_pose(*scene.figures().at("body").tree));
  const Vec3 touch = scene.goals().at("g1").at.point;
  const Revision came = scene.goals().at("g1").revision;

  expect_edited("body", 3, [&] { return scene.set_figure(tempus_entry("body", 1.4), {}); });
  EXPECT_EQ(scene.figures().at("body").q, q);
  EXPECT_EQ(scene.goals().at("g1").revision, came);
  EXPECT_TRUE(scene.bindings().contains("b1"));
  // The goal's place is the new hand's touch point.
  EXPECT_NEAR(glm::length(scene.goals().at("g1").at.point), glm::length(touch) * 1.4 / 1.75, 1e-12);
}

TEST_F(FigureEdits, AnotherFigureStartsInItsOwnPose) {
  expect_edited("body", 2, [&] { return scene.set_figure(small_entry("body"), {}); });
  EXPECT_EQ(scene.figures().at("body").q, (std::vector<double>{0, 0, 0, 1}));
}

TEST_F(FigureEdits, AFigureThatLacksAGoalsPlaceIsRefused) {
  ASSERT_TRUE(scene.set_goal(goal_edit("g1"), {}));
  expect_refused("unknown_segment", "/id", [&] { return scene.set_figure(small_entry("body"), {}); });
}

TEST_F(FigureEdits, SetRefusesWhatIsNoFigure) {
  FigureEntry both = small_entry("x");
  both.template_name = "tempus";
  expect_refused("invalid_params", "/template", [&] { return scene.set_figure(both, {}); });
  FigureEntry neither;
  neither.id = "x";
  expect_refused("missing_field", "/template", [&] { return scene.set_figure(neither, {}); });
  FigureEntry unknown = tempus_entry("x");
  unknown.template_name = "robot";
  expect_refused("bad_figure", "/template", [&] { return scene.set_figure(unknown, {}); });
  expect_refused("out_of_range", "/stature", [&] { return scene.set_figure(tempus_entry("x", 9.0), {}); });
  expect_refused("bad_id", "/id", [&] { return scene.set_figure(tempus_entry("a b"), {}); });
  FigureEntry orphan = small_entry("x");
  orphan.document->segments[1].parent = "nobody";
  expect_refused("bad_figure", "/document/segments/1/parent", [&] { return scene.set_figure(orphan, {}); });
  FigureEntry bad_q = small_entry("x");
  bad_q.q = {0, 0, 0, 2};
  expect_refused("out_of_range", "/q/0", [&] { return scene.set_figure(bad_q, {}); });
}

TEST_F(FigureEdits, SetComparesTheFiguresOwnRevision) {
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.set_figure(tempus_entry("body"), 0); });
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.set_figure(tempus_entry("new"), 1); });
  expect_edited("new", 1, [&] { return scene.set_figure(tempus_entry("new"), 0); });
  expect_edited("body", 2, [&] { return scene.set_figure(tempus_entry("body"), 1); });
}

TEST_F(FigureEdits, RemoveTakesItsGoalsAndTheirBindingsAlong) {
  ASSERT_TRUE(scene.set_figure(small_entry("other"), {}));
  GoalEdit on_other = goal_edit("keeps", "tip");
  on_other.figure = "other";
  ASSERT_TRUE(scene.set_goal(on_other, {}));
  ASSERT_TRUE(scene.set_goal(goal_edit("goes"), {}));
  ASSERT_TRUE(scene.set_binding(binding_edit("b1", "goes"), {}));
  ASSERT_TRUE(scene.set_binding(binding_edit("b2", "keeps"), {}));
  expect_edited("body", 0, [&] { return scene.remove_figure("body", 1); });
  EXPECT_EQ(scene.goals().size(), 1u);
  EXPECT_TRUE(scene.goals().contains("keeps"));
  EXPECT_EQ(scene.bindings().size(), 1u);
  EXPECT_TRUE(scene.bindings().contains("b2"));
}

TEST_F(FigureEdits, RemoveRefusesTheUnknownAndTheStale) {
  expect_refused("unknown_figure", "/id", [&] { return scene.remove_figure("bod", {}); });
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.remove_figure("body", 7); });
}

TEST_F(FigureEdits, SetQ) {
  std::vector<double> q = scene.figures().at("body").q;
  q[2] += 0.1;
  expect_edited("body", 2, [&] { return scene.set_q("", q, 1); });
  EXPECT_EQ(scene.figures().at("body").q, q);
  expect_refused("unknown_figure", "/figure", [&] { return scene.set_q("nobody", q, {}); });
  expect_refused("invalid_params", "/q", [&] { return scene.set_q("body", {1, 2, 3}, {}); });
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.set_q("body", q, 1); });
  q[12] = std::nan("");
  expect_refused("not_finite", "/q/12", [&] { return scene.set_q("body", q, {}); });
}

TEST_F(FigureEdits, SettleIsNoEdit) {
  std::vector<double> q = scene.figures().at("body").q;
  q[1] = 0.5;
  const Revision before = scene.revision();
  scene.settle("body", q);
  EXPECT_EQ(scene.figures().at("body").q, q);
  EXPECT_EQ(scene.document().figures.at("body").q, q);
  EXPECT_EQ(scene.revision(), before);
  EXPECT_EQ(scene.figures().at("body").revision, 1u);
  scene.settle("nobody", q);
}

TEST_F(FigureEdits, AnEmptyNameMeansTheOnlyFigureElseBody) {
  EXPECT_EQ((*scene.find_figure(""))->entry.id, "body");
  ASSERT_TRUE(scene.set_figure(small_entry("a"), {}));
  EXPECT_EQ((*scene.find_figure(""))->entry.id, "body");
  ASSERT_TRUE(scene.remove_figure("body", {}));
  EXPECT_EQ((*scene.find_figure(""))->entry.id, "a");
  ASSERT_TRUE(scene.set_figure(small_entry("b"), {}));
  const auto ambiguous = scene.find_figure("");
  ASSERT_FALSE(ambiguous);
  EXPECT_EQ(ambiguous.error().code, "ambiguous_figure");
  EXPECT_EQ(ambiguous.error().hint, "one of: a b");
  Scene empty;
  EXPECT_EQ(empty.find_figure("").error().code, "unknown_figure");
}

}  // namespace
}  // namespace posed
