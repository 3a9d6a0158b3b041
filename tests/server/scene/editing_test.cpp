// Undo, redo and holds of several editors.
#include <algorithm>

#include "tests/server/scene/editing_fixture.h"

namespace posed {
namespace {

TEST_F(EditingTest, UndoBringsTheDocumentBackAndRedoDoesItAgain) {
  const std::string empty = document();
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  const std::string one = document();
  const Revision came = scene.goals().at("g1").revision;
  ASSERT_TRUE(edit(by("ana"), [](Scene& s) { return s.remove_goal("g1", {}); }));
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(document(), one);
  EXPECT_GT(scene.goals().at("g1").revision, came) << "an entity's revision only grows";
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(document(), empty);
  EXPECT_EQ(editing.undo(by("ana")).error().code, "nothing_to_undo");
  ASSERT_TRUE(editing.redo(by("ana")));
  EXPECT_EQ(document(), one);
  ASSERT_TRUE(editing.redo(by("ana")));
  EXPECT_EQ(document(), empty);
  EXPECT_EQ(editing.redo(by("ana")).error().code, "nothing_to_redo");
}

TEST_F(EditingTest, EachUndoesTheirOwn) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  ASSERT_TRUE(set(by("ben"), "g2", {2, 0, 0}));
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_FALSE(scene.goals().contains("g1"));
  EXPECT_TRUE(scene.goals().contains("g2"));
  EXPECT_EQ(editing.undo(by("cyn")).error().code, "nothing_to_undo");
}

TEST_F(EditingTest, WhatAnotherHasChangedSinceIsNotTakenBack) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  ASSERT_TRUE(set(by("ben"), "g1", {2, 0, 0}));
  expect_refused("undo_conflict", "", [&] { return editing.undo(by("ana")); });
  EXPECT_NE(editing.undo(by("ana")).error().message.find("ben"), std::string::npos);
  ASSERT_TRUE(edit(by("ben"), [](Scene& s) { return s.remove_goal("g1", {}); }));
  EXPECT_NE(editing.undo(by("ana")).error().message.find("removed by ben"), std::string::npos);
  // Once ben has taken his back, ana's is the last again.
  ASSERT_TRUE(editing.undo(by("ben")));
  ASSERT_TRUE(editing.undo(by("ben")));
  EXPECT_EQ(position("g1"), Vec3(1, 0, 0));
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_FALSE(scene.goals().contains("g1"));
}

TEST_F(EditingTest, AnEarlierStepMayBeNamed) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  const std::uint64_t first = editing.history().steps().back().number;
  ASSERT_TRUE(set(by("ana"), "g2", {1, 0, 0}));
  ASSERT_TRUE(set(by("ben"), "g2", {2, 0, 0}));
  EXPECT_EQ(editing.undo(by("ana")).error().code, "undo_conflict");
  ASSERT_TRUE(editing.undo(by("ana"), first));
  EXPECT_FALSE(scene.goals().contains("g1"));
  EXPECT_EQ(editing.undo(by("ben"), first).error().code, "nothing_to_undo") << "it is not ben's";
}

TEST_F(EditingTest, TheOldPoseComesBack) {
  solved(0.25);
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  solved(0.5);
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(pose(), 0.25);
  ASSERT_TRUE(editing.redo(by("ana")));
  EXPECT_EQ(pose(), 0.5);
}

TEST_F(EditingTest, APoseThatAnotherHasHadToDoWithStaysAsItIs) {
  solved(0.25);
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  solved(0.5);
  ASSERT_TRUE(set(by("ben"), "g2", {1, 0, 0}));
  solved(0.75);
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_FALSE(scene.goals().contains("g1"));
  EXPECT_EQ(pose(), 0.75);
}

TEST_F(EditingTest, APoseSetByHandIsAnEditLikeAnother) {
  const auto set_pose = [&](const std::string& who, double x) {
    std::vector<double> q = scene.figures().at("body").q;
    q[0] = x;
    return edit(by(who), [&](Scene& s) { return s.set_q("body", q, {}); });
  };
  solved(0.25);
  ASSERT_TRUE(set_pose("ana", 1.0));
  EXPECT_EQ(editing.history().steps().back().change.entities(), (std::vector<std::string>{"/figures/body/q"}));
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(pose(), 0.25);
  ASSERT_TRUE(editing.redo(by("ana")));
  EXPECT_EQ(pose(), 1.0);
  ASSERT_TRUE(set_pose("ben", 2.0));
  expect_refused("undo_conflict", "", [&] { return editing.undo(by("ana")); });
}

TEST_F(EditingTest, AnotherStatureIsTakenBackWithThePose) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  solved(0.25);
  const std::string before = document();
  ASSERT_TRUE(edit(by("ana"), [&](Scene& s) { return s.set_figure(tempus_entry("body", 1.6), {}); }));
  solved(0.5);
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(document(), before);
  ASSERT_TRUE(edit(by("ana"), [&](Scene& s) { return s.remove_figure("body", {}); }));
  EXPECT_TRUE(scene.goals().empty());
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(document(), before);
  // The goal is fitted to the figure that is there.
  EXPECT_EQ(scene.goals().at("g1").at.segment, *scene.figures().at("body").tree->find_segment("right_hand"));
}

TEST_F(EditingTest, WhatHangsOnWhatIsGoneIsAConflict) {
  ASSERT_TRUE(edit(by("ana"), [&](Scene& s) { return s.set_figure(tempus_entry("other"), {}); }));
  GoalEdit on_other = goal_edit("g1");
  on_other.figure = "other";
  ASSERT_TRUE(edit(by("ben"), [&](Scene& s) { return s.set_goal(on_other, {}); }));
  expect_refused("undo_conflict", "", [&] { return editing.undo(by("ana")); });
  EXPECT_NE(editing.undo(by("ana")).error().message.find("goal g1 was changed by ben"), std::string::npos);
  ASSERT_TRUE(edit(by("ben"), [](Scene& s) { return s.remove_goal("g1", {}); }));
  ASSERT_TRUE(edit(by("cyn"), [](Scene& s) { return s.remove_figure("other", {}); }));
  expect_refused("undo_conflict", "", [&] { return editing.undo(by("ben")); });
  EXPECT_NE(editing.undo(by("ben")).error().message.find("figure other was removed by cyn"), std::string::npos);
}

TEST_F(EditingTest, SeveralEditsAreAllOrNothing) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  const auto several = [&](const std::string& last) {
    return edit(by("ana"), [&](Scene& s) -> Result<Edited> {
      EXPECT_TRUE(s.remove_goal("g1", {}));
      EXPECT_TRUE(s.set_figure(tempus_entry("body", 1.5), {}));
      std::vector<double> q = s.figures().at("body").q;
      q[0] = 5.0;
      EXPECT_TRUE(s.set_q("body", q, {}));
      EXPECT_TRUE(s.pin("body", "left_foot", Pin::Hold::pose, {}));
      return s.set_goal(goal_edit("g2", last), {});
    });
  };
  expect_refused("unknown_segment", "/at", [&] { return several("left_hnd"); });
  const Revision before = scene.revision();
  ASSERT_TRUE(several("left_hand"));
  EXPECT_EQ(scene.revision(), before + 1);
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_TRUE(scene.goals().contains("g1"));
  EXPECT_EQ(scene.figures().at("body").entry.stature, 1.75);
  EXPECT_NE(pose(), 5.0);
}

TEST_F(EditingTest, AWholeSceneIsTakenBack) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  const std::string before = document();
  SceneDocument other;
  other.figures["body"] = tempus_entry("body", 1.5);
  const auto loaded = editing.edit(by("ben"), [&](Scene& s) { return s.load(other); });
  ASSERT_TRUE(loaded);
  EXPECT_TRUE(scene.goals().empty());
  ASSERT_TRUE(editing.undo(by("ben")));
  EXPECT_EQ(document(), before);
  ASSERT_TRUE(editing.undo(by("ana")));
}

TEST_F(EditingTest, ABindingTakenBackLetsTheGoalGo) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  ASSERT_TRUE(edit(by("ana"), [](Scene& s) { return s.set_binding(binding_edit("b1", "g1"), {}); }));
  ASSERT_TRUE(scene.follow(frame({5, 5, 5})));
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_EQ(target("g1"), Vec3(1, 0, 0));
  EXPECT_FALSE(scene.goals().at("g1").follows_sensors());
}

TEST_F(EditingTest, AHeldGoalIsItsHoldersUntilTheyIdle) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  ASSERT_TRUE(editing.grab(by("ana"), "g1"));
  expect_refused("held", "/id", [&] { return set(by("ben"), "g1", {2, 0, 0}); });
  EXPECT_NE(set(by("ben"), "g1", {2, 0, 0}).error().message.find("ana"), std::string::npos);
  expect_refused("held", "/id", [&] { return editing.grab(by("ben"), "g1"); });
  expect_refused("held", "/id", [&] { return edit(by("ben"), [](Scene& s) { return s.remove_figure("body", {}); }); });
  expect_refused("held", "/id",
                 [&] { return edit(by("ben"), [](Scene& s) { return s.set_binding(binding_edit("b", "g1"), {}); }); });
  now += 4'000'000'000;
  ASSERT_TRUE(set(by("ana"), "g1", {3, 0, 0}));  // no idling
  now += 4'000'000'000;
  expect_refused("held", "/id", [&] { return set(by("ben"), "g1", {2, 0, 0}); });
  now += 1'000'000'000;
  EXPECT_TRUE(set(by("ben"), "g1", {2, 0, 0}));
}

TEST_F(EditingTest, AHoldEndsWithAReleaseADisconnectOrByForce) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  ASSERT_TRUE(editing.grab(by("ana"), "g1"));
  EXPECT_EQ(editing.release(by("ben"), "g1").error().code, "held");
  ASSERT_TRUE(editing.release(by("ana"), "g1"));
  EXPECT_TRUE(set(by("ben"), "g1", {2, 0, 0}));
  ASSERT_TRUE(editing.grab(by("ana"), "g1"));
  editing.gone(by("ana").owner);
  EXPECT_TRUE(set(by("ben"), "g1", {3, 0, 0}));
  ASSERT_TRUE(editing.grab(by("ana"), "g1"));
  EditBy forcing = by("ben");
  forcing.force = true;
  EXPECT_TRUE(set(forcing, "g1", {4, 0, 0}));
  ASSERT_TRUE(editing.grab(forcing, "g1"));
  EXPECT_EQ(set(by("ana"), "g1", {5, 0, 0}).error().code, "held");
  EXPECT_EQ(editing.grab(by("ana"), "g9").error().code, "unknown_goal");
}

TEST_F(EditingTest, HistoryIsBounded) {
  for (std::size_t i = 0; i < History::kMostSteps + 10; ++i) ASSERT_TRUE(set(by("ana"), "g1", {double(i), 0, 0}));
  EXPECT_EQ(editing.history().steps().size(), History::kMostSteps);
}

// Undone it keeps what it had made, and was taken off the count with more than it had been counted with: all went.
TEST_F(EditingTest, AnUndoneStepThatIsForgottenTakesNoOtherAlong) {
  ASSERT_TRUE(set(by("ben"), "g2", {0, 0, 0}));
  ASSERT_TRUE(editing.undo(by("ben")));
  for (std::size_t i = 0; i < History::kMostSteps; ++i) ASSERT_TRUE(set(by("ana"), "g1", {double(i), 0, 0}));
  EXPECT_EQ(editing.history().steps().size(), History::kMostSteps);
}

TEST_F(EditingTest, EditsThatAreDiscardedHaveNeverBeen) {
  ASSERT_TRUE(set(by("ana", "drag"), "g1", {1, 0, 0}));
  const std::string before = document();
  std::vector<Done> lost;
  ASSERT_TRUE(editing.take_done());
  ASSERT_TRUE(set(by("ana", "drag"), "g1", {2, 0, 0}));
  lost.push_back(*editing.take_done());
  ASSERT_TRUE(set(by("ben"), "g2", {2, 0, 0}));
  lost.push_back(*editing.take_done());
  ASSERT_TRUE(editing.undo(by("ben")));
  lost.push_back(*editing.take_done());
  editing.discard(lost);
  EXPECT_EQ(document(), before);
  EXPECT_EQ(editing.undo(by("ben")).error().code, "nothing_to_undo");
}

// Removed and made anew in one edit it looked as if nothing had been done: both were at revision 1.
TEST_F(EditingTest, WhatIsMadeAnewInOneEditIsAChange) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  const Revision came = scene.goals().at("g1").revision;
  ASSERT_TRUE(edit(by("ben"), [](Scene& s) -> Result<Edited> {
    EXPECT_TRUE(s.remove_goal("g1", {}));
    return s.set_goal(goal_edit("g1", "right_hand", {2, 0, 0}), {});
  }));
  EXPECT_GT(scene.goals().at("g1").revision, came);
  EXPECT_EQ(editing.undo(by("ana")).error().code, "undo_conflict");
  ASSERT_TRUE(editing.undo(by("ben")));
  EXPECT_EQ(position("g1"), Vec3(1, 0, 0));
}

// Who had read the goal before it was removed could set the one that came after it: both were at revision 1.
TEST_F(EditingTest, NoRevisionComesTwiceUnderAnId) {
  std::vector<Revision> seen;
  const auto look = [&](const char* what) {
    const Revision there = scene.goals().at("g1").revision;
    EXPECT_EQ(std::count(seen.begin(), seen.end(), there), 0) << what << " comes to revision " << there << " again";
    seen.push_back(there);
  };
  const auto remove = [](Scene& s) { return s.remove_goal("g1", {}); };
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  look("the goal");
  ASSERT_TRUE(edit(by("ana"), remove));
  ASSERT_TRUE(set(by("ben"), "g1", {2, 0, 0}));
  look("the goal made anew");
  ASSERT_TRUE(set(by("ben"), "g1", {3, 0, 0}));
  look("its change");
  ASSERT_TRUE(editing.undo(by("ben")));
  look("the undone change");
  ASSERT_TRUE(editing.undo(by("ben")));
  ASSERT_TRUE(editing.undo(by("ana")));
  look("the undone removal");
  ASSERT_TRUE(set(by("ana"), "g1", {4, 0, 0}));
  look("the last change");
  // One edit that came to the goal often took it beyond the scene's revision, where what came after began.
  ASSERT_TRUE(edit(by("ana"), [](Scene& s) {
    for (double x = 0; x < 9; ++x) EXPECT_TRUE(s.set_goal(goal_edit("g1", "right_hand", {x, 0, 0}), {}));
    return s.set_goal(goal_edit("g1"), {});
  }));
  look("many changes in one edit");
  ASSERT_TRUE(edit(by("ana"), remove));
  for (double x = 0; x < 9; ++x) {
    ASSERT_TRUE(set(by("ben"), "g1", {x, 0, 0}));
    look("the goal made anew, and its changes");
  }
}

// Its goal did not exist any more in any state in between: ben could not have gone back.
TEST_F(EditingTest, WhatOthersHaveBuiltOnStaysThoughNothingHangsOnItNow) {
  const auto place = [](Scene& s) { return s.set_object({"o1", Vec3(1, 0, 0), {}, {}, {}, {}}, {}); };
  ASSERT_TRUE(edit(by("ana"), place));
  GoalEdit on_it = goal_edit("g1");
  on_it.relative_to = GoalBase{GoalBase::Kind::object, "", "", "", "o1"};
  ASSERT_TRUE(edit(by("ben"), [&](Scene& s) { return s.set_goal(on_it, {}); }));
  ASSERT_TRUE(edit(by("ben"), [](Scene& s) { return s.remove_goal("g1", {}); }));
  expect_refused("undo_conflict", "", [&] { return editing.undo(by("ana")); });
  EXPECT_NE(editing.undo(by("ana")).error().message.find("goal g1 was removed by ben"), std::string::npos);
  ASSERT_TRUE(editing.undo(by("ben")));
  ASSERT_TRUE(editing.undo(by("ben")));
  ASSERT_TRUE(editing.undo(by("ana")));
}

// A goal of ben's that came and went left ana's pose under a number that nobody had.
TEST_F(EditingTest, APoseIsTakenBackWhateverGoalsCameAndWentSince) {
  std::vector<double> q = scene.figures().at("body").q;
  q[0] = 1.0;
  ASSERT_TRUE(edit(by("ana"), [&](Scene& s) { return s.set_q("body", q, {}); }));
  ASSERT_TRUE(set(by("ben"), "g1", {1, 0, 0}));
  ASSERT_TRUE(set(by("ana"), "g2", {1, 0, 0}));
  ASSERT_TRUE(editing.undo(by("ben")));
  ASSERT_TRUE(editing.undo(by("ana")));
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_NE(pose(), 1.0);
}

TEST_F(EditingTest, AFigureThatIsMadeAndPosedInOneEditComesBack) {
  const std::string before = document();
  ASSERT_TRUE(edit(by("ana"), [&](Scene& s) -> Result<Edited> {
    EXPECT_TRUE(s.set_figure(tempus_entry("other"), {}));
    std::vector<double> q = s.figures().at("other").q;
    q[0] = 1.0;
    return s.set_q("other", q, {});
  }));
  expect_back_and_forth(by("ana"), before);
}

// A pose of the figure's other form has another length.
TEST_F(EditingTest, NoPoseOfAnotherFormComesBack) {
  ASSERT_TRUE(set(by("ana"), "g1", {1, 0, 0}));
  ASSERT_TRUE(edit(by("ana"), [](Scene& s) { return s.remove_goal("g1", {}); }));
  ASSERT_TRUE(edit(by("ana"), [](Scene& s) { return s.set_figure(small_entry("body"), {}); }));
  const std::uint64_t form = editing.history().steps().back().number;
  const auto place = [](Scene& s) { return s.set_object({"o1", Vec3(1, 0, 0), {}, {}, {}, {}}, {}); };
  ASSERT_TRUE(edit(by("ben"), place));
  GoalEdit on_tip = goal_edit("g2", "tip");
  ASSERT_TRUE(edit(by("ben"), [&](Scene& s) { return s.set_goal(on_tip, {}); }));
  EXPECT_EQ(editing.undo(by("ana"), form).error().code, "undo_conflict");
  ASSERT_TRUE(editing.undo(by("ben")));
  ASSERT_TRUE(editing.undo(by("ana"), form));
  ASSERT_TRUE(editing.undo(by("ben")));
  EXPECT_EQ(scene.figures().at("body").q.size(), static_cast<std::size_t>(scene.figures().at("body").tree->q_size()));
}

// Lost with the disk, an undo leaves its step to be undone again; a drag's second half leaves the first.
TEST_F(EditingTest, WhatIsDiscardedLeavesTheHistoryAsItWas) {
  ASSERT_TRUE(set(by("ana", "drag"), "g1", {1, 0, 0}));
  editing.take_done();
  ASSERT_TRUE(set(by("ana", "drag"), "g1", {2, 0, 0}));
  std::vector<Done> lost{*editing.take_done()};
  ASSERT_TRUE(editing.undo(by("ana")));
  lost.push_back(*editing.take_done());
  editing.discard(std::move(lost));
  EXPECT_EQ(position("g1"), Vec3(1, 0, 0));
  ASSERT_TRUE(editing.undo(by("ana")));
  EXPECT_FALSE(scene.goals().contains("g1"));
}

}  // namespace
}  // namespace posed
