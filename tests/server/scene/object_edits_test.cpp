#include "server/scene/spring_goals.h"
#include "tests/server/scene/scene_fixture.h"

namespace posed {
namespace {

class ObjectEdits : public SceneTest {
 protected:
  static ObjectEdit object_edit(std::string id, Vec3 position = {1, 0, 0.5}) {
    ObjectEdit edit;
    edit.id = std::move(id);
    edit.position = position;
    return edit;
  }
  static GoalEdit seat(std::string id, std::string object) {
    GoalEdit edit = goal_edit(std::move(id), "lower_torso", {0, 0, 0.1});
    GoalBase base;
    base.kind = GoalBase::Kind::object;
    base.object = std::move(object);
    edit.relative_to = base;
    return edit;
  }
  static BindingEdit carrying(std::string id, std::string object) {
    BindingEdit edit = binding_edit(std::move(id), "");
    edit.to = BindingTarget{"", std::move(object), "", "", ""};
    return edit;
  }
  // What the solver is told.
  Transform base(const std::string& goal) const { return spring_goal(scene.goals().at(goal)).world_from_base; }
  const Transform& placed(const std::string& object) const { return scene.objects().at(object).world_from_object(); }
};

TEST_F(ObjectEdits, OnlyTheNamedFieldsChangeAndNullRestores) {
  ObjectEdit first = object_edit("chair");
  first.rotation = quat_about(kZ, 1.0);
  first.shapes = std::vector<Shape>{{Shape::Kind::box, {0, 0, 0}, {0.2, 0.2, 0.02}, 0.0}};
  first.label = std::string("blue");
  expect_edited("chair", 1, [&] { return scene.set_object(first, 0); });
  ObjectEdit move;
  move.id = "chair";
  move.position = Vec3(2, 0, 0);
  expect_edited("chair", 2, [&] { return scene.set_object(move, nth("chair", 1)); });
  const Object& moved = scene.objects().at("chair").object;
  EXPECT_EQ(moved.world_from_object.position, Vec3(2, 0, 0));
  EXPECT_EQ(moved.world_from_object.rotation, quat_about(kZ, 1.0));
  EXPECT_EQ(moved.shapes.size(), 1u);
  EXPECT_EQ(moved.label, "blue");
  ObjectEdit null;
  null.id = "chair";
  null.position = Patched<Vec3>::reset();
  null.rotation = Patched<Quat>::reset();
  null.shapes = Patched<std::vector<Shape>>::reset();
  ASSERT_TRUE(scene.set_object(null, {}));
  const Object& restored = scene.objects().at("chair").object;
  EXPECT_EQ(restored.world_from_object.position, kZero);
  EXPECT_EQ(restored.world_from_object.rotation, quat_identity());
  EXPECT_TRUE(restored.shapes.empty());
}

TEST_F(ObjectEdits, WhatIsWrongIsTold) {
  expect_refused("bad_id", "/id", [&] { return scene.set_object(object_edit("a b"), {}); });
  expect_refused("out_of_range", "/position/1", [&] { return scene.set_object(object_edit("a", {0, 2e6, 0}), {}); });
  ObjectEdit turned = object_edit("a");
  turned.rotation = Quat(2, 0, 0, 0);
  expect_refused("invalid_params", "/quat_xyzw", [&] { return scene.set_object(turned, {}); });
  ObjectEdit shaped = object_edit("a");
  shaped.shapes = std::vector<Shape>{{}, {Shape::Kind::box, {0, 0, 0}, {0.2, -0.2, 0.02}, 0.0}};
  expect_refused("out_of_range", "/shape/1", [&] { return scene.set_object(shaped, {}); });
  shaped.shapes = std::vector<Shape>(65);
  expect_refused("out_of_range", "/shape", [&] { return scene.set_object(shaped, {}); });
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.set_object(object_edit("a"), 1); });
  expect_refused("unknown_object", "/id", [&] { return scene.remove_object("a", {}); });
  expect_refused("unknown_object", "/relative_to/object", [&] { return scene.set_goal(seat("sit", "chair"), {}); });
  expect_refused("unknown_object", "/to/object", [&] { return scene.set_binding(carrying("b", "chair"), {}); });
}

TEST_F(ObjectEdits, GoalsRideOnAnObject) {
  ASSERT_TRUE(scene.set_object(object_edit("chair", {1, 0, 0.5}), {}));
  ASSERT_TRUE(scene.set_goal(seat("sit", "chair"), {}));
  EXPECT_EQ(base("sit").position, Vec3(1, 0, 0.5));
  EXPECT_FALSE(scene.goals().at("sit").follows_sensors());
  const Revision came = scene.goals().at("sit").revision;
  ObjectEdit turn = object_edit("chair", {2, 0, 0.5});
  turn.rotation = quat_about(kZ, 0.5);
  ASSERT_TRUE(scene.set_object(turn, {}));
  EXPECT_EQ(base("sit").position, Vec3(2, 0, 0.5));
  EXPECT_EQ(base("sit").rotation, quat_about(kZ, 0.5));
  EXPECT_EQ(scene.goals().at("sit").revision, came) << "the goal's own document is as it was";
}

TEST_F(ObjectEdits, AnObjectThatGoalsHangOnStays) {
  expect_edited("chair", 1, [&] { return scene.set_object(object_edit("chair"), {}); });
  ASSERT_TRUE(scene.set_goal(seat("sit", "chair"), {}));
  ASSERT_TRUE(scene.set_goal(seat("lean", "chair"), {}));
  expect_refused("in_use", "/id", [&] { return scene.remove_object("chair", {}); });
  EXPECT_NE(scene.remove_object("chair", {}).error().message.find("lean, sit"), std::string::npos);
  ASSERT_TRUE(scene.remove_goal("lean", {}));
  GoalEdit away;
  away.id = "sit";
  away.relative_to = GoalBase{};
  ASSERT_TRUE(scene.set_goal(away, {}));
  ASSERT_TRUE(scene.set_binding(carrying("b1", "chair"), {}));
  expect_edited("chair", 0, [&] { return scene.remove_object("chair", nth("chair", 1)); });
  EXPECT_TRUE(scene.bindings().empty());
}

TEST_F(ObjectEdits, ABoundObjectTakesItsGoalsAlong) {
  ASSERT_TRUE(scene.set_object(object_edit("chair"), {}));
  ASSERT_TRUE(scene.set_goal(seat("sit", "chair"), {}));
  ASSERT_TRUE(scene.set_binding(carrying("b1", "chair"), {}));
  Frame moved = frame({1, 2, 3});
  moved.samples[0].rotation = quat_about(kX, 0.3);
  const Revision revision = scene.revision(), chair = scene.objects().at("chair").revision;
  EXPECT_TRUE(scene.follow(moved));
  EXPECT_FALSE(scene.follow(moved));
  EXPECT_EQ(scene.revision(), revision);
  EXPECT_EQ(base("sit").position, Vec3(1, 2, 3));
  EXPECT_EQ(base("sit").rotation, quat_about(kX, 0.3));
  EXPECT_TRUE(scene.goals().at("sit").follows_sensors());
  EXPECT_EQ(scene.document().objects.at("chair").world_from_object.position, Vec3(1, 0, 0.5))
      << "live motion is no edit";
  // Let go, it stays there.
  ASSERT_TRUE(scene.remove_binding("b1", {}));
  EXPECT_EQ(placed("chair").position, Vec3(1, 2, 3));
  EXPECT_EQ(scene.document().objects.at("chair").world_from_object.position, Vec3(1, 2, 3));
  EXPECT_EQ(scene.objects().at("chair").revision, chair + 1);
  EXPECT_FALSE(scene.goals().at("sit").follows_sensors());
}

TEST_F(ObjectEdits, AxesChooseWhatFollows) {
  ASSERT_TRUE(scene.set_object(object_edit("chair"), {}));
  BindingEdit edit = carrying("b1", "chair");
  edit.axes = Axes{true};
  ASSERT_TRUE(scene.set_binding(edit, {}));
  Frame moved = frame({5, 6, 7});
  moved.samples[0].rotation = quat_about(kX, 0.3);
  ASSERT_TRUE(scene.follow(moved));
  EXPECT_EQ(placed("chair").position, Vec3(5, 0, 0.5));
  EXPECT_EQ(placed("chair").rotation, quat_identity());
  edit.axes = Patched<Axes>::reset();
  ASSERT_TRUE(scene.set_binding(edit, {}));
  EXPECT_EQ(scene.bindings().at("b1").binding.axes, kAllAxes);
}

TEST_F(ObjectEdits, RelativeMotionTurnsAsTheSensorTurns) {
  ObjectEdit chair = object_edit("chair");
  chair.rotation = quat_about(kZ, 1.0);
  ASSERT_TRUE(scene.set_object(chair, {}));
  BindingEdit edit = carrying("b1", "chair");
  edit.mode = Binding::Mode::relative;
  ASSERT_TRUE(scene.set_binding(edit, {}));
  Frame at = frame({9, 9, 9});
  at.samples[0].rotation = quat_about(kY, 2.0);
  ASSERT_TRUE(scene.follow(at));
  EXPECT_LT(glm::length(placed("chair").rotation - quat_about(kZ, 1.0)), 1e-12);
  at.samples[0].position = {9, 9, 10};
  at.samples[0].rotation = quat_about(kZ, 0.25) * quat_about(kY, 2.0);
  ASSERT_TRUE(scene.follow(at));
  EXPECT_LT(glm::length(placed("chair").position - Vec3(1, 0, 1.5)), 1e-12);
  EXPECT_LT(glm::length(placed("chair").rotation - quat_about(kZ, 1.25)), 1e-12);
}

TEST_F(ObjectEdits, ComeAndGoWithTheDocument) {
  ASSERT_TRUE(scene.set_object(object_edit("chair"), {}));
  ASSERT_TRUE(scene.set_goal(seat("sit", "chair"), {}));
  ASSERT_TRUE(scene.set_binding(carrying("b1", "chair"), {}));
  const std::string text = proto::encode_scene(scene.document());
  Scene other;
  ASSERT_TRUE(other.load(*proto::decode_scene(text)));
  EXPECT_EQ(proto::encode_scene(other.document()), text);
  EXPECT_EQ(spring_goal(other.goals().at("sit")).world_from_base.position, Vec3(1, 0, 0.5));
  SceneDocument broken = scene.document();
  broken.objects.clear();
  const Status refused = other.load(broken);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().path, "/goals/sit/relative_to/object");
}

}  // namespace
}  // namespace posed
