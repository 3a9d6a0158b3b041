// Buttons of a sensor that do something to its binding.
#include "tests/server/scene/scene_fixture.h"
#include "tests/support/allocation_counter.h"

namespace posed {
namespace {

using Do = ButtonAction::Do;

class BindingButtons : public SceneTest {
 protected:
  BindingButtons() { EXPECT_TRUE(scene.set_goal(goal_edit("g1", "right_hand", {1, 0, 1}), {})); }

  void bind(std::vector<ButtonAction> buttons, Binding::Mode mode = Binding::Mode::relative) {
    BindingEdit edit = binding_edit("b", "g1");
    edit.mode = mode;
    edit.buttons = std::move(buttons);
    ASSERT_TRUE(scene.set_binding(edit, {}));
  }
  // The sensor is at x, with these buttons held.
  Scene::Followed at(double x, std::uint32_t buttons = 0) {
    Frame f = frame({x, 0, 0});
    f.samples[0].buttons = buttons;
    return scene.follow(f);
  }
};

TEST_F(BindingButtons, RecenterBringsTheTargetBackAndItMovesOnFromThere) {
  bind({{1, Do::recenter}});
  at(5.0);
  at(5.5);
  EXPECT_NEAR(target("g1").x, 1.5, 1e-12);
  EXPECT_TRUE(at(5.5, 2).pose);
  EXPECT_NEAR(target("g1").x, 1.0, 1e-12) << "where the document has it";
  at(5.6, 2);
  EXPECT_NEAR(target("g1").x, 1.1, 1e-12) << "held, it is pressed once";
  at(5.7);
  EXPECT_NEAR(target("g1").x, 1.2, 1e-12);
}

TEST_F(BindingButtons, RecenterWorksWithTheClutchLifted) {
  BindingEdit edit = binding_edit("b", "g1");
  edit.mode = Binding::Mode::relative;
  edit.clutch = Clutch{0};
  edit.buttons = std::vector<ButtonAction>{{1, Do::recenter}};
  ASSERT_TRUE(scene.set_binding(edit, {}));
  at(5.0, 1);
  at(5.5, 1);
  at(7.0, 0);
  EXPECT_NEAR(target("g1").x, 1.5, 1e-12);
  EXPECT_TRUE(at(7.0, 2).pose);
  EXPECT_NEAR(target("g1").x, 1.0, 1e-12);
  at(8.0, 1);
  at(8.25, 1);
  EXPECT_NEAR(target("g1").x, 1.25, 1e-12);
}

TEST_F(BindingButtons, RecenterBringsAJointBackToWhereItStood) {
  BindingEdit edit;
  edit.id = "b";
  edit.sensor = "simulated:1";
  edit.to = BindingTarget{"", "", "", "left_elbow", "body"};
  edit.mode = Binding::Mode::relative;
  edit.buttons = std::vector<ButtonAction>{{0, Do::recenter}};
  ASSERT_TRUE(scene.set_binding(edit, {}));
  const auto turned = [&](double angle, std::uint32_t buttons) {
    Frame f = frame(kZero);
    f.samples[0].rotation = quat_about(kZ, angle);
    f.samples[0].buttons = buttons;
    scene.follow(f);
    return scene.bindings().at("b").share;
  };
  const auto stood = turned(0.0, 0);
  const auto away = turned(0.7, 0);
  const auto back = turned(0.7, 1);
  double moved = 0.0, off = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    moved = std::max(moved, std::abs(away[i] - stood[i]));
    off = std::max(off, std::abs(back[i] - stood[i]));
  }
  EXPECT_GT(moved, 0.1);
  EXPECT_LT(off, 1e-12);
}

TEST_F(BindingButtons, TogglePausesAndGoesOn) {
  bind({{0, Do::toggle}});
  at(5.0);
  at(5.5);
  EXPECT_FALSE(at(5.5, 1));
  EXPECT_FALSE(at(9.0, 0)) << "it stays where it is";
  EXPECT_NEAR(target("g1").x, 1.5, 1e-12);
  at(9.0, 1);
  EXPECT_NEAR(target("g1").x, 1.5, 1e-12) << "taken up again, nothing jumps";
  at(9.25, 0);
  EXPECT_NEAR(target("g1").x, 1.75, 1e-12);
}

TEST_F(BindingButtons, AnAbsoluteBindingTogglesToo) {
  bind({{0, Do::toggle}}, Binding::Mode::absolute);
  at(5.0);
  at(5.0, 1);
  at(6.0);
  EXPECT_NEAR(target("g1").x, 5.0, 1e-12);
  at(6.0, 1);
  EXPECT_NEAR(target("g1").x, 6.0, 1e-12);
}

TEST_F(BindingButtons, WhatIsHeldFromTheBeginningWasNotPressed) {
  bind({{0, Do::save}});
  EXPECT_TRUE(at(5.0, 1).saving.empty());
  EXPECT_TRUE(at(5.0, 0).saving.empty());
  EXPECT_EQ(at(5.0, 1).saving, std::vector<std::string>{"b"});
  EXPECT_TRUE(at(5.0, 1).saving.empty());
}

TEST_F(BindingButtons, AsItStandsIsWhereTheSensorsHaveThingsAndNothingIsBound) {
  ObjectEdit object;
  object.id = "chair";
  ASSERT_TRUE(scene.set_object(object, {}));
  CameraEdit camera;
  camera.id = "main";
  camera.position = Vec3(0, 0, 1);
  ASSERT_TRUE(scene.set_camera(camera, {}));
  bind({{0, Do::save}}, Binding::Mode::absolute);
  BindingEdit carry = binding_edit("c", "");
  carry.to = BindingTarget{"", "chair", "", "", ""};
  ASSERT_TRUE(scene.set_binding(carry, {}));
  carry.id = "d";
  carry.to = BindingTarget{"", "", "main", "", ""};
  ASSERT_TRUE(scene.set_binding(carry, {}));
  at(5.0);
  const SceneDocument stands = scene.as_it_stands();
  EXPECT_EQ(position_of(stands.goals.at("g1").payload)->x, 5.0);
  EXPECT_EQ(stands.objects.at("chair").world_from_object.position.x, 5.0);
  EXPECT_EQ(stands.cameras.at("main").base_from_camera.position.x, 5.0);
  EXPECT_TRUE(stands.bindings.empty());
  EXPECT_EQ(scene.bindings().size(), 3u);
  Scene again;
  EXPECT_TRUE(again.load(stands));
}

TEST_F(BindingButtons, ButtonsThatCanNotBeAreRefused) {
  const auto refuse = [&](std::vector<ButtonAction> buttons, Binding::Mode mode, const char* code, const char* path) {
    BindingEdit edit = binding_edit("b", "g1");
    edit.mode = mode;
    edit.clutch = Clutch{3};
    edit.buttons = std::move(buttons);
    expect_refused(code, path, [&] { return scene.set_binding(edit, {}); });
  };
  refuse({{32, Do::toggle}}, Binding::Mode::relative, "out_of_range", "/buttons/0/button");
  refuse({{0, Do::toggle}, {-1, Do::toggle}}, Binding::Mode::relative, "out_of_range", "/buttons/1/button");
  refuse({{0, Do::toggle}, {0, Do::save}}, Binding::Mode::relative, "invalid_params", "/buttons/1/button");
  refuse({{3, Do::toggle}}, Binding::Mode::relative, "invalid_params", "/buttons/0/button");
  refuse({{0, Do::recenter}}, Binding::Mode::absolute, "invalid_params", "/buttons/0/do");
}

TEST_F(BindingButtons, NullTakesThemAway) {
  bind({{0, Do::toggle}});
  BindingEdit edit = binding_edit("b", "g1");
  edit.buttons = Patched<std::vector<ButtonAction>>::reset();
  ASSERT_TRUE(scene.set_binding(edit, {}));
  EXPECT_TRUE(scene.bindings().at("b").binding.buttons.empty());
}

TEST_F(BindingButtons, ToFollowAllocatesNothing) {
  bind({{0, Do::toggle}, {1, Do::recenter}});
  Frame f = frame({1, 2, 3});
  scene.follow(f);
  const std::size_t before = test::allocation_count();
  for (std::uint32_t i = 0; i < 100; ++i) {
    f.samples[0].position.x += 0.01;
    f.samples[0].buttons = i % 4;
    scene.follow(f);
  }
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace posed
