// Keys as edits and moves of the cameras, without a terminal or a daemon.
#include "client/cli/view/desk.h"

#include <gtest/gtest.h>

#include <functional>

#include "client/cli/view/words.h"
#include "standing.h"

namespace posed::view {
namespace {

constexpr Size kSize{80, 24};

class AtTheDesk : public ::testing::Test {
 protected:
  AtTheDesk() { desk.follow(station, kSize, 0.0); }

  std::optional<Edit> press(Command command, bool shift = false, double now = 0.0) {
    return desk.act(command, shift, station, kSize, now).edit;
  }
  // The goal's place, or weight, as the daemon would have it after the edit.
  void change(const std::function<void(Goal&)>& with) {
    auto entities = std::make_shared<Entities>(*station.entities);
    with(entities->goals[1].goal);
    station.entities = entities;
  }

  Station station = test::standing();
  Desk desk{"t"};
};

TEST_F(AtTheDesk, AGoalWithAPlaceIsChosenAtFirst) {
  EXPECT_EQ(desk.goal(), "body.left_arm.position");
  press(Command::next_goal);
  EXPECT_EQ(desk.goal(), "balance");
  press(Command::previous_goal);
  EXPECT_EQ(desk.goal(), "body.left_arm.position");
}

TEST_F(AtTheDesk, NudgesGoInTheViewsPlane) {
  press(Command::front);
  EXPECT_EQ(press(Command::nudge_right)->params,
            R"({"id":"body.left_arm.position","position":[0.4,0.81,1.2],"gesture":"t-1"})");
  EXPECT_EQ(press(Command::nudge_up, true)->params,
            R"({"id":"body.left_arm.position","position":[0.4,0.81,1.3],"gesture":"t-1"})");
  press(Command::top);
  EXPECT_EQ(press(Command::nudge_up)->params,
            R"({"id":"body.left_arm.position","position":[0.39,0.81,1.3],"gesture":"t-1"})");
  press(Command::step), press(Command::step);
  EXPECT_EQ(press(Command::nudge_farther)->params,
            R"({"id":"body.left_arm.position","position":[0.39,0.81,1.299],"gesture":"t-1"})");
}

TEST_F(AtTheDesk, ThereAndBackIsTheSamePlace) {
  press(Command::front);
  for (int i = 0; i < 37; ++i) press(Command::nudge_up);
  for (int i = 0; i < 37; ++i) press(Command::nudge_down);
  EXPECT_EQ(position_of(desk.wanted(desk.goal(), station)->payload)->z, 1.2);
}

TEST_F(AtTheDesk, NudgesInQuickSuccessionAreOneGestureAndWaitAsOneEdit) {
  press(Command::front);
  const auto first = press(Command::nudge_right, false, 1.0), second = press(Command::nudge_right, false, 1.5);
  const auto later = press(Command::nudge_right, false, 9.0);
  EXPECT_EQ(first->key, second->key);
  EXPECT_NE(second->key, later->key);
  EXPECT_NE(press(Command::heavier, false, 9.1)->key, later->key);
}

TEST_F(AtTheDesk, WhatIsOnItsWayIsShownUntilItIsAnswered) {
  press(Command::front);
  press(Command::nudge_right);
  desk.sent(1);
  EXPECT_NEAR(position_of(desk.wanted(desk.goal(), station)->payload)->y, 0.81, 1e-9);
  desk.follow(station, kSize, 0.1);
  EXPECT_EQ(desk.pending().size(), 1u);
  press(Command::nudge_right);
  desk.sent(2);
  station.edits_done = 1;  // of the first alone
  desk.follow(station, kSize, 0.2);
  EXPECT_NEAR(position_of(desk.wanted(desk.goal(), station)->payload)->y, 0.82, 1e-9);
  station.edits_done = 2;  // refused: the daemon's place is the goal's again
  desk.follow(station, kSize, 0.3);
  EXPECT_TRUE(desk.pending().empty());
  EXPECT_NEAR(position_of(desk.wanted(desk.goal(), station)->payload)->y, 0.8, 1e-9);
}

TEST_F(AtTheDesk, WeightsGoByTenNotchesToTheDecade) {
  EXPECT_EQ(press(Command::heavier)->params, R"({"id":"body.left_arm.position","weight":13,"gesture":"t-1"})");
  for (int i = 0; i < 9; ++i) press(Command::heavier);
  EXPECT_EQ(weight_text(desk.wanted(desk.goal(), station)->weight), "100");
  for (int i = 0; i < 200; ++i) press(Command::lighter);
  EXPECT_EQ(weight_text(desk.wanted(desk.goal(), station)->weight), "0.01");
  change([](Goal& goal) { goal.weight = 10.0, goal.weight.orientation = 1.0; });
  EXPECT_EQ(weight_text(notched(station.entities->goals[1].goal.weight, true)), "13/1.3");
}

TEST_F(AtTheDesk, OnAndOff) {
  EXPECT_EQ(press(Command::on_off)->params, R"({"id":"body.left_arm.position","enabled":false})");
  EXPECT_EQ(press(Command::on_off)->params, R"({"id":"body.left_arm.position","enabled":true})");
}

TEST_F(AtTheDesk, UndoAndRedo) {
  EXPECT_EQ(press(Command::undo)->method, "edit.undo");
  EXPECT_EQ(press(Command::redo)->method, "edit.redo");
}

// The first goal in a chair that is turned by a quarter.
void sit(Station& station) {
  auto entities = std::make_shared<Entities>(*station.entities);
  Object chair;
  chair.id = "chair";
  chair.world_from_object.rotation = quat_about(kZ, 1.5707963267948966);
  entities->objects = {chair};
  entities->goals[1].goal.relative_to = {GoalBase::Kind::object, "", "", "", "chair"};
  station.entities = entities;
}

TEST_F(AtTheDesk, AGoalRelativeToATurnedObjectMovesAsItIsSeen) {
  sit(station);
  press(Command::front);  // right is +Y, the chair's +X
  EXPECT_EQ(press(Command::nudge_right)->params,
            R"({"id":"body.left_arm.position","position":[0.41,0.8,1.2],"gesture":"t-1"})");
}

TEST_F(AtTheDesk, ASensorHasTheLastWordOnHowAnObjectIsTurned) {
  sit(station);
  auto pose = std::make_shared<proto::PoseData>(*station.pose);
  pose->objects = {{"chair", {}}};
  station.pose = pose;
  press(Command::front);
  EXPECT_EQ(press(Command::nudge_right)->params,
            R"({"id":"body.left_arm.position","position":[0.4,0.81,1.2],"gesture":"t-1"})");
}

TEST_F(AtTheDesk, OtherKindsMoveByTheirPoint) {
  press(Command::front);
  change([](Goal& goal) { goal.payload = AimTarget{{1, 0, 0}, Vec3(2, 0, 1), {}}; });
  EXPECT_EQ(press(Command::nudge_right)->params,
            R"({"id":"body.left_arm.position","aim":{"axis":[1,0,0],"point":[2,0.01,1]},"gesture":"t-1"})");
  station = test::standing();
  desk = Desk("t");
  desk.follow(station, kSize, 0.0);
  press(Command::front);
  change([](Goal& goal) { goal.payload = PlaneTarget{{0, 0, 0.5}, {0, 0, 1}, PlaneTarget::Side::above}; });
  EXPECT_EQ(
      press(Command::nudge_up)->params,
      R"({"id":"body.left_arm.position","plane":{"point":[0,0,0.51],"normal":[0,0,1],"side":"above"},"gesture":"t-1"})");
}

TEST_F(AtTheDesk, WhatCanNotBeNudgedIsSaid) {
  press(Command::next_goal);
  EXPECT_FALSE(press(Command::nudge_up));
  ASSERT_NE(desk.note(0.1), nullptr);
  EXPECT_EQ(desk.note(0.1)->text, "a goal of kind balance has no place to move");
  EXPECT_EQ(desk.note(60.0), nullptr);
  press(Command::next_goal);
  auto entities = std::make_shared<Entities>(*station.entities);
  entities->bindings.resize(1);
  entities->bindings[0].sensor = "liberty:1";
  entities->bindings[0].to.goal = "body.left_arm.position";
  station.entities = entities;
  EXPECT_FALSE(press(Command::nudge_up));
  EXPECT_EQ(desk.note(0.1)->text, "left arm is led by liberty:1");
  station.entities = std::make_shared<Entities>();
  desk.follow(station, kSize, 0.2);
  EXPECT_FALSE(press(Command::heavier));
  EXPECT_EQ(desk.note(0.3)->text, "there is no goal to change");
}

TEST_F(AtTheDesk, ViewsAreChosenAndStandAlone) {
  EXPECT_EQ(desk.view(), View::perspective);
  press(Command::side);
  EXPECT_TRUE(desk.view() == View::side && !desk.alone());
  press(Command::side);
  EXPECT_TRUE(desk.alone());
  press(Command::leave);
  EXPECT_FALSE(desk.alone());
  press(Command::next_view);
  EXPECT_EQ(desk.view(), View::top);
  press(Command::previous_view);
  EXPECT_EQ(desk.view(), View::side);
}

TEST_F(AtTheDesk, EscapeClosesTheHelpFirst) {
  press(Command::maximise), press(Command::help), press(Command::leave);
  EXPECT_TRUE(!desk.help() && desk.alone());
  EXPECT_EQ(desk.act(Command::quit, false, station, kSize, 0.0).then, Desk::Then::quit);
}

TEST_F(AtTheDesk, TheDaemonsWordsAreShownOnce) {
  station.notes = 1;
  station.note = {"ana holds it", true};
  desk.follow(station, kSize, 10.0);
  ASSERT_NE(desk.note(11.0), nullptr);
  EXPECT_TRUE(desk.note(11.0)->bad);
  desk.follow(station, kSize, 20.0);
  EXPECT_EQ(desk.note(20.0), nullptr);
}

TEST(Words, AreThoseOfEveryday) {
  EXPECT_EQ(metres_text(0.0341), "34.1 mm");
  EXPECT_EQ(metres_text(0.3412), "341 mm");
  EXPECT_EQ(metres_text(1.2), "1.20 m");
  EXPECT_EQ(goal_name("body.left_hand.position"), "left hand");
  EXPECT_EQ(goal_name("my_goal"), "my goal");
  std::vector<proto::GoalFrame::Because> causes(4);
  causes[0].goal = "body.left_hand.position";
  causes[1].limit = "right_elbow";
  causes[2].pin = "left_foot";
  causes[2].figure = "ana";
  causes[3].beyond_m = 0.12;
  EXPECT_EQ(causes_text(causes),
            "held by left hand; right elbow at its limit; held by the pin of ana's left foot; 120 mm beyond reach");
}

}  // namespace
}  // namespace posed::view
