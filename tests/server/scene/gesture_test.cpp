// Gestures: edits that are one step to undo, with what others do meanwhile.
#include "tests/server/scene/editing_fixture.h"

namespace posed {
namespace {

using GestureTest = EditingTest;

TEST_F(GestureTest, AGestureIsOneStep) {
  ASSERT_TRUE(set(by("ana"), "g1", {0, 0, 0}));
  solved(0.25);
  for (int i = 1; i <= 10; ++i) {
    ASSERT_TRUE(set(by("ana", "drag-1"), "g1", {i, 0, 0}));
    solved(0.25 + i);
  }
  EXPECT_EQ(editing.history().steps().size(), 2u);
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(position("g1"), Vec3(0, 0, 0));
  EXPECT_EQ(pose(), 0.25);
  ASSERT_TRUE(editing.redo(by("ana")));
  EXPECT_EQ(position("g1"), Vec3(10, 0, 0));
  EXPECT_EQ(pose(), 10.25);
}

// Joined over it, ben's edit would have been lost by ana's undo.
TEST_F(GestureTest, AGestureDoesNotSwallowAnothersEdit) {
  ASSERT_TRUE(set(by("ana", "drag-1"), "g1", {1, 0, 0}));
  ASSERT_TRUE(set(by("ben"), "g1", {2, 0, 0}));
  ASSERT_TRUE(set(by("ana", "drag-1"), "g1", {3, 0, 0}));
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(position("g1"), Vec3(2, 0, 0));
}

TEST_F(GestureTest, TwoDragsSideBySideAreTwoSteps) {
  for (int i = 1; i <= 10; ++i) {
    ASSERT_TRUE(set(by("ana", "drag-1"), "g1", {i, 0, 0}));
    ASSERT_TRUE(set(by("ben", "drag-2"), "g2", {0, i, 0}));
  }
  EXPECT_EQ(editing.history().steps().size(), 2u);
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_FALSE(scene.goals().contains("g1"));
  EXPECT_EQ(position("g2"), Vec3(0, 10, 0));
}

// The binding had been made before the gesture, undone, and made again within it: joined to the gesture's goal, whose
// undo it then stood in the way of, and could itself not be undone.
TEST_F(GestureTest, AGestureTakesInNothingThatCameBackMeanwhile) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  ASSERT_TRUE(edit(by("ben"), [](Scene& s) { return s.set_binding(binding_edit("b1", "g1"), {}); }));
  ASSERT_TRUE(editing.undo(by("ben")));
  ASSERT_TRUE(editing.undo(by("ana")));
  ASSERT_TRUE(set(by("cyn", "drag"), "g2", {1, 0, 0}));
  ASSERT_TRUE(editing.redo(by("ana")));
  ASSERT_TRUE(editing.redo(by("ben")));
  ASSERT_TRUE(edit(by("cyn", "drag"), [](Scene& s) {
    BindingEdit other = binding_edit("b1", "g2");
    return s.set_binding(other, {});
  }));
  EXPECT_EQ(editing.history().steps().size(), 4u) << "ben's edit of the binding came between";
  for (const char* name : {"cyn", "cyn", "ben", "ana"}) EXPECT_TRUE(editing.undo(by(name))) << name;
}

TEST_F(GestureTest, AGestureGoesOnThoughOthersEditWhatHasNothingToDoWithIt) {
  ASSERT_TRUE(set(by("ana", "drag"), "g1", {1, 0, 0}));
  ASSERT_TRUE(edit(by("ben"), [](Scene& s) { return s.set_binding(binding_edit("b1", "g1"), {}); }));
  ASSERT_TRUE(set(by("ana", "drag"), "g1", {2, 0, 0}));
  EXPECT_EQ(editing.history().steps().size(), 2u);
  ASSERT_TRUE(editing.undo(by("ben")));
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_FALSE(scene.goals().contains("g1"));
}

// The pose that a gesture began with was forgotten where the gesture took the figure away and made it anew: undo
// brought the new one's, under a number that others' steps did not know.
TEST_F(GestureTest, AGestureThatMakesAFigureAnewGivesTheOldOnesPoseBack) {
  ASSERT_TRUE(edit(by("ana"), [&](Scene& s) { return s.set_figure(tempus_entry("other"), {}); }));
  ASSERT_TRUE(move(by("ben"), 1.0, "other"));
  const std::string before = document();
  std::vector<double> q = scene.figures().at("other").q;
  ASSERT_TRUE(edit(by("ana", "drag"), [](Scene& s) { return s.remove_figure("other", {}); }));
  ASSERT_TRUE(edit(by("ana", "drag"), [&](Scene& s) -> Result<Edited> {
    EXPECT_TRUE(s.set_figure(tempus_entry("other"), {}));
    q[0] = 2.0;
    return s.set_q("other", q, {});
  }));
  expect_back_and_forth(by("ana"), before);
  for (const char* name : {"ana", "ben", "ana"}) {
    const Result<Done> undone = editing.undo(by(name));
    EXPECT_TRUE(undone) << name << ": " << undone.error().message;
  }
}

// The gesture's goal remembered the pose of ben's step, which was not there any more when the gesture set its own.
TEST_F(GestureTest, AGesturesPoseGivesBackWhatItHasReplaced) {
  const std::vector<double> q = scene.figures().at("body").q;
  ASSERT_TRUE(move(by("ben"), 1.0));
  ASSERT_TRUE(set(by("ana", "drag"), "g1", {1, 0, 0}));
  ASSERT_TRUE(editing.undo(by("ben")));
  ASSERT_TRUE(move(by("ana", "drag"), 2.0));
  ASSERT_EQ(editing.history().steps().size(), 2u);
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(scene.figures().at("body").q, q);
}

// Ben's pose was undone after the gesture had changed the figure: undo brought it back.
TEST_F(GestureTest, AGestureThatChangesAFigureAndRemovesItGivesTheLastPoseBack) {
  ASSERT_TRUE(move(by("ben"), 1.0));
  const std::string before = document();
  ASSERT_TRUE(move(by("ben"), 2.0));
  ASSERT_TRUE(edit(by("ana", "drag"), [](Scene& s) { return s.set_figure(tempus_entry("body", 1.8), {}); }));
  ASSERT_TRUE(editing.undo(by("ben")));
  ASSERT_TRUE(edit(by("ana", "drag"), [](Scene& s) { return s.remove_figure("body", {}); }));
  ASSERT_EQ(editing.history().steps().size(), 3u);
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(document(), before);
  EXPECT_TRUE(editing.undo(by("ben")));
}

TEST_F(GestureTest, AGestureThatPosesAFigureChangesItAndRemovesItGivesTheFirstPoseBack) {
  ASSERT_TRUE(move(by("ben"), 1.0));
  const std::string before = document();
  ASSERT_TRUE(move(by("ana", "drag"), 2.0));
  ASSERT_TRUE(edit(by("ana", "drag"), [](Scene& s) { return s.set_figure(tempus_entry("body", 1.8), {}); }));
  ASSERT_TRUE(edit(by("ana", "drag"), [](Scene& s) { return s.remove_figure("body", {}); }));
  ASSERT_EQ(editing.history().steps().size(), 2u);
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(document(), before);
  EXPECT_TRUE(editing.undo(by("ben")));
}

TEST_F(GestureTest, AGestureThatPosesAFigureAndRemovesItGivesTheFirstPoseBack) {
  ASSERT_TRUE(move(by("ben"), 1.0));
  const std::string before = document();
  ASSERT_TRUE(move(by("ana", "drag"), 2.0));
  ASSERT_TRUE(edit(by("ana", "drag"), [](Scene& s) { return s.remove_figure("body", {}); }));
  expect_back_and_forth(by("ana"), before);
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_TRUE(editing.undo(by("ben")));
}

}  // namespace
}  // namespace posed
