// Sensors that turn joints and goals, clutches and offsets.
#include "server/scene/spring_goals.h"
#include "server/solver/kinematics.h"
#include "tests/server/scene/scene_fixture.h"
#include "tests/support/allocation_counter.h"

namespace posed {
namespace {

class FollowJoints : public SceneTest {
 protected:
  // A leaning post with a hinge about its own Y and a ball on it.
  static FigureEntry post() {
    FigureDocument document;
    document.root = "base";
    Segment base, door, ball;
    base.name = "base";
    base.joint.name = "base_joint";
    base.joint.type = JointType::fixed;
    base.joint.parent_from_joint.rotation = quat_about(kX, 0.5);
    door.name = "door";
    door.parent = "base";
    door.joint.name = "hinge";
    door.joint.type = JointType::hinge;
    door.joint.axes = {kY};
    door.touch_point = {0, 0, 0.5};
    ball.name = "hand";
    ball.parent = "door";
    ball.joint.name = "wrist";
    ball.joint.type = JointType::ball;
    ball.joint.parent_from_joint = {{0, 0, 0.5}, quat_about(kZ, 0.3)};
    ball.touch_point = {0, 0, 0.2};
    document.segments = {base, door, ball};
    FigureEntry entry;
    entry.id = "post";
    entry.document = document;
    return entry;
  }
  FollowJoints() { EXPECT_TRUE(scene.set_figure(post(), {})); }

  static BindingEdit joint_edit(std::string id, std::string joint) {
    BindingEdit edit;
    edit.id = std::move(id);
    edit.sensor = "simulated:1";
    edit.to = BindingTarget{"", "", "", std::move(joint), "post"};
    return edit;
  }
  static Frame turned(const Quat& rotation, std::uint32_t buttons = 0, Vec3 position = kZero) {
    Frame f = frame(position);
    f.samples[0].rotation = rotation;
    f.samples[0].buttons = buttons;
    return f;
  }
  const SceneBinding& binding(const std::string& id) const { return scene.bindings().at(id); }
  // As the solver would have it.
  void take_over(const std::string& id) {
    const SceneBinding& b = binding(id);
    std::vector<double> q = scene.figures().at("post").q;
    const int at = scene.figures().at("post").tree->q_at(b.joint);
    const int size = b.binding.to.joint == "hinge" ? 1 : 4;
    std::copy_n(b.share.begin(), size, q.begin() + at);
    scene.settle("post", q);
  }
  Quat world_of(int segment) const {
    const SceneFigure& figure = scene.figures().at("post");
    return world_rotation(*figure.tree, segment, figure.q);
  }
};

TEST_F(FollowJoints, AbsoluteTurnsTheSegmentAsTheSensorIs) {
  ASSERT_TRUE(scene.set_binding(joint_edit("b", "wrist"), {}));
  EXPECT_EQ(binding("b").binding.axes, kTurns);
  const Quat wanted = quat_about(glm::normalize(Vec3(1, 2, 3)), 1.1);
  const Revision revision = scene.revision();
  EXPECT_TRUE(scene.follow(turned(wanted)).pose);
  EXPECT_FALSE(scene.follow(turned(wanted)));
  take_over("b");
  EXPECT_GT(std::abs(glm::dot(world_of(2), wanted)), 1.0 - 1e-12);
  EXPECT_EQ(scene.revision(), revision);
  const SpringGoal spring = joint_spring(binding("b"), *scene.figures().at("post").tree);
  EXPECT_TRUE(spring.enabled);
  EXPECT_EQ(spring.priority, kJointPriority);
}

TEST_F(FollowJoints, AHingeTakesTheAngleAboutItsAxis) {
  ASSERT_TRUE(scene.set_binding(joint_edit("b", "hinge"), {}));
  // The hinge's frame leans as the base does; the sensor turns about the hinge's axis, and a bit about another.
  const Quat base = quat_about(kX, 0.5);
  ASSERT_TRUE(scene.follow(turned(base * quat_about(kY, 0.7))));
  EXPECT_NEAR(binding("b").share[0], 0.7, 1e-12);
  ASSERT_TRUE(scene.follow(turned(base * quat_about(kX, 0.2) * quat_about(kY, -0.4))));
  EXPECT_NEAR(binding("b").share[0], -0.4, 1e-12);
}

TEST_F(FollowJoints, RelativeTurnsAsTheHandDoesWhereverItBegan) {
  BindingEdit edit = joint_edit("b", "wrist");
  edit.mode = Binding::Mode::relative;
  ASSERT_TRUE(scene.set_binding(edit, {}));
  const Quat before = world_of(2), grip = quat_about(kY, 2.0);
  scene.follow(turned(grip));
  take_over("b");
  EXPECT_GT(std::abs(glm::dot(world_of(2), before)), 1.0 - 1e-12) << "to take hold moves nothing";
  ASSERT_TRUE(scene.follow(turned(quat_about(kZ, 0.25) * grip)));
  take_over("b");
  EXPECT_GT(std::abs(glm::dot(world_of(2), quat_about(kZ, 0.25) * before)), 1.0 - 1e-12);
}

TEST_F(FollowJoints, AClutchIsAMouseThatIsLifted) {
  GoalEdit goal = goal_edit("g1", "right_hand", {0, 0, 1});
  goal.figure = "body";
  ASSERT_TRUE(scene.set_goal(goal, {}));
  BindingEdit edit = binding_edit("b", "g1");
  edit.mode = Binding::Mode::relative;
  edit.clutch = Clutch{1};
  ASSERT_TRUE(scene.set_binding(edit, {}));
  const auto at = [&](double x, bool held) { return scene.follow(turned(quat_identity(), held ? 2 : 1, {x, 0, 0})); };
  EXPECT_FALSE(at(5.0, false)) << "another button is none";
  at(5.0, true);
  EXPECT_TRUE(at(5.2, true));
  EXPECT_NEAR(target("g1").x, 0.2, 1e-12);
  EXPECT_FALSE(at(4.0, false)) << "lifted, the hand goes back";
  EXPECT_NEAR(target("g1").x, 0.2, 1e-12);
  at(4.0, true);
  EXPECT_NEAR(target("g1").x, 0.2, 1e-12) << "set down, nothing jumps";
  EXPECT_TRUE(at(4.3, true));
  EXPECT_NEAR(target("g1").x, 0.5, 1e-12);
}

TEST_F(FollowJoints, PoseAndOrientationGoalsTurn) {
  GoalEdit edit = goal_edit("g1", "right_hand", {0, 0, 1});
  edit.figure = "body";
  edit.orientation = OrientationTarget{};
  ASSERT_TRUE(scene.set_goal(edit, {}));
  GoalEdit look;
  look.id = "look";
  look.figure = "body";
  look.at = Attachment{"head", {}, ""};
  look.orientation = OrientationTarget{};
  ASSERT_TRUE(scene.set_goal(look, {}));
  ASSERT_TRUE(scene.set_binding(binding_edit("b1", "g1"), {}));
  ASSERT_TRUE(scene.set_binding(binding_edit("b2", "look"), {}));
  EXPECT_EQ(binding("b1").binding.axes, kAllAxes);
  EXPECT_EQ(binding("b2").binding.axes, kTurns);
  const Quat turn = quat_about(kZ, 0.6);
  ASSERT_TRUE(scene.follow(turned(turn, 0, {1, 2, 3})));
  const SpringGoal pose = spring_goal(scene.goals().at("g1"));
  EXPECT_EQ(std::get<PoseSpring>(pose.spring).position, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<PoseSpring>(pose.spring).rotation, turn);
  EXPECT_EQ(std::get<OrientationSpring>(spring_goal(scene.goals().at("look")).spring).rotation, turn);
  // Let go, both stay.
  ASSERT_TRUE(scene.remove_binding("b1", {}));
  ASSERT_TRUE(scene.remove_binding("b2", {}));
  EXPECT_EQ(std::get<PoseTarget>(goal("g1").payload).rotation, turn);
  EXPECT_EQ(std::get<OrientationTarget>(goal("look").payload).rotation, turn);
  EXPECT_EQ(std::get<OrientationSpring>(scene.goals().at("look").spring).rotation, turn);
}

TEST_F(FollowJoints, WhatCanNotFollowIsRefused) {
  GoalEdit edit = goal_edit("g1");
  edit.figure = "body";
  ASSERT_TRUE(scene.set_goal(edit, {}));
  BindingEdit turns = binding_edit("b", "g1");
  turns.axes = Axes{true, true, true, true};
  expect_refused("invalid_params", "/axes", [&] { return scene.set_binding(turns, {}); });
  turns.axes = Axes{};
  expect_refused("invalid_params", "/axes", [&] { return scene.set_binding(turns, {}); });
  BindingEdit moves = joint_edit("b", "wrist");
  moves.axes = kAllAxes;
  expect_refused("invalid_params", "/axes", [&] { return scene.set_binding(moves, {}); });
  expect_refused("unknown_joint", "/to/joint", [&] { return scene.set_binding(joint_edit("b", "wrst"), {}); });
  expect_refused("invalid_params", "/to/joint", [&] { return scene.set_binding(joint_edit("b", "base_joint"), {}); });
  BindingEdit nobody = joint_edit("b", "wrist");
  nobody.to->figure = "ana";
  expect_refused("unknown_figure", "/to/figure", [&] { return scene.set_binding(nobody, {}); });
  BindingEdit button = joint_edit("b", "wrist");
  button.clutch = Clutch{32};
  expect_refused("out_of_range", "/clutch/button", [&] { return scene.set_binding(button, {}); });
  BindingEdit filter = joint_edit("b", "wrist");
  filter.filter = BindingFilter{OneEuro{0.0, 0.0, 1.0}, 0.0};
  expect_refused("out_of_range", "/filter/one_euro/min_cutoff_hz", [&] { return scene.set_binding(filter, {}); });
  filter.filter = BindingFilter{{}, 200.0};
  expect_refused("out_of_range", "/filter/predict_ms", [&] { return scene.set_binding(filter, {}); });
  BindingEdit offset = joint_edit("b", "wrist");
  offset.offset = SensorOffset{{0, 0, 200}, quat_identity()};
  expect_refused("out_of_range", "/offset/position/2", [&] { return scene.set_binding(offset, {}); });
  ASSERT_TRUE(scene.set_binding(joint_edit("b", "wrist"), {}));
  expect_refused("invalid_params", "/to/joint", [&] { return scene.set_binding(joint_edit("b2", "wrist"), {}); });
  expect_refused("unknown_joint", "/id", [&] { return scene.set_figure(small_entry("post"), {}); });
  ASSERT_TRUE(scene.remove_figure("post", {}));
  EXPECT_TRUE(scene.bindings().empty());
}

// A figure whose joints stand in another order, taken back: the binding found its joint where it was in the other one.
TEST_F(FollowJoints, AFigureThatIsTakenBackHasItsJointsAgain) {
  ASSERT_TRUE(scene.set_binding(joint_edit("b", "wrist"), {}));
  ASSERT_EQ(binding("b").joint, 2);
  FigureEntry longer = post();
  Segment more;
  more.name = "shelf";
  more.parent = "base";
  more.joint.name = "shelf_joint";
  more.joint.type = JointType::fixed;
  auto& segments = longer.document->segments;
  segments.insert(segments.begin() + 1, more);
  scene.begin();
  ASSERT_TRUE(scene.set_figure(longer, {}));
  EXPECT_EQ(binding("b").joint, 3);
  scene.rollback();
  EXPECT_EQ(binding("b").joint, 2);
  scene.begin();
  ASSERT_TRUE(scene.set_figure(longer, {}));
  Change change = scene.commit();
  EXPECT_EQ(change.entities(), std::vector<std::string>{"/figures/post"});
  ASSERT_FALSE(scene.revert(change));
  EXPECT_EQ(binding("b").joint, 2);
  scene.follow(turned(quat_about(kX, 0.3)));
  EXPECT_TRUE(binding("b").moves_joint);
}

TEST_F(FollowJoints, DoesNotAllocate) {
  BindingEdit edit = joint_edit("b", "wrist");
  edit.mode = Binding::Mode::relative;
  edit.offset = SensorOffset{{0.1, 0, 0}, quat_identity()};
  ASSERT_TRUE(scene.set_binding(edit, {}));
  ASSERT_TRUE(scene.set_binding(joint_edit("b2", "hinge"), {}));
  CameraEdit camera;
  camera.id = "main";
  ASSERT_TRUE(scene.set_camera(camera, {}));
  BindingEdit eye = joint_edit("b3", "");
  eye.to = BindingTarget{"", "", "main", "", ""};
  ASSERT_TRUE(scene.set_binding(eye, {}));
  const Frame f = turned(quat_about(kX, 0.3), 1, {1, 1, 1});
  const std::size_t before = test::allocation_count();
  const bool moved = scene.follow(f).pose;
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_TRUE(moved);
}

}  // namespace
}  // namespace posed
