#include "tests/server/scene/scene_fixture.h"
#include "tests/support/allocation_counter.h"

namespace posed {
namespace {

class Follow : public SceneTest {
 protected:
  Follow() { EXPECT_TRUE(scene.set_goal(goal_edit("g1", "right_hand", {0.4, -0.3, 1.2}), {})); }

  void bind(BindingEdit edit) { ASSERT_TRUE(scene.set_binding(edit, {})); }
};

TEST_F(Follow, AbsoluteGoesWhereTheSensorIs) {
  bind(binding_edit("b1", "g1"));
  EXPECT_TRUE(scene.follow(frame({1, 2, 3})));
  EXPECT_EQ(target("g1"), Vec3(1, 2, 3));
  // The document keeps the place that was set: motion is no edit.
  EXPECT_EQ(position("g1"), Vec3(0.4, -0.3, 1.2));
}

TEST_F(Follow, IsNoEdit) {
  bind(binding_edit("b1", "g1"));
  const Revision before = scene.revision();
  const Revision goal_before = scene.goals().at("g1").revision;
  const std::string document = proto::encode_scene(scene.document());
  EXPECT_TRUE(scene.follow(frame({1, 2, 3})));
  EXPECT_EQ(scene.revision(), before);
  EXPECT_EQ(scene.goals().at("g1").revision, goal_before);
  EXPECT_EQ(proto::encode_scene(scene.document()), document);
}

TEST_F(Follow, TellsWhetherAnythingMoved) {
  bind(binding_edit("b1", "g1"));
  EXPECT_TRUE(scene.follow(frame({1, 2, 3})));
  EXPECT_FALSE(scene.follow(frame({1, 2, 3})));
  EXPECT_TRUE(scene.follow(frame({1, 2, 3.5})));
}

TEST_F(Follow, ScaleMultiplies) {
  BindingEdit edit = binding_edit("b1", "g1");
  edit.scale = 2.0;
  bind(edit);
  EXPECT_TRUE(scene.follow(frame({1, 2, 3})));
  EXPECT_EQ(target("g1"), Vec3(2, 4, 6));
}

TEST_F(Follow, AxesLeftOutStayWhereTheDocumentHasThem) {
  BindingEdit edit = binding_edit("b1", "g1");
  edit.axes = Axes{true, false, true};
  bind(edit);
  EXPECT_TRUE(scene.follow(frame({1, 2, 3})));
  EXPECT_EQ(target("g1"), Vec3(1, -0.3, 3));
}

// It sprang back to where the document had it with the next sample; where the binding went first, it did not.
TEST_F(Follow, AxesThatAreLetGoStayWhereTheSensorLeftThem) {
  BindingEdit edit = binding_edit("b1", "g1");
  bind(edit);
  EXPECT_TRUE(scene.follow(frame({1, 2, 3})));
  edit.axes = Axes{false, true, true};
  bind(edit);
  EXPECT_TRUE(scene.follow(frame({4, 5, 6})));
  EXPECT_EQ(target("g1"), Vec3(1, 5, 6));
  ASSERT_TRUE(scene.remove_binding("b1", {}));
  EXPECT_EQ(position("g1"), Vec3(1, 5, 6));
}

TEST_F(Follow, RelativeStartsFromWhereBothStood) {
  BindingEdit edit = binding_edit("b1", "g1");
  edit.mode = Binding::Mode::relative;
  edit.scale = 2.0;
  bind(edit);
  EXPECT_TRUE(scene.follow(frame({10, 10, 10})));
  EXPECT_LT(glm::length(target("g1") - Vec3(0.4, -0.3, 1.2)), 1e-12);
  EXPECT_TRUE(scene.follow(frame({10.1, 10, 9.9})));
  EXPECT_LT(glm::length(target("g1") - Vec3(0.6, -0.3, 1.0)), 1e-12);
}

TEST_F(Follow, RelativeAgainGoesOnFromWhereTheGoalIsNow) {
  BindingEdit edit = binding_edit("b1", "g1");
  bind(edit);
  EXPECT_TRUE(scene.follow(frame({1, 1, 1})));
  edit.mode = Binding::Mode::relative;
  bind(edit);
  scene.follow(frame({5, 5, 5}));
  EXPECT_LT(glm::length(target("g1") - Vec3(1, 1, 1)), 1e-12);
  EXPECT_TRUE(scene.follow(frame({5, 5, 6})));
  EXPECT_LT(glm::length(target("g1") - Vec3(1, 1, 2)), 1e-12);
}

TEST_F(Follow, AnAbsentSensorMovesNothing) {
  bind(binding_edit("b1", "g1"));
  EXPECT_FALSE(scene.follow(frame({1, 2, 3}, 2)));
  Frame other = frame({1, 2, 3});
  other.device = "liberty";
  EXPECT_FALSE(scene.follow(other));
  Frame nothing = frame({1, 2, 3});
  nothing.samples.clear();
  EXPECT_FALSE(scene.follow(nothing));
  EXPECT_EQ(target("g1"), Vec3(0.4, -0.3, 1.2));
  EXPECT_TRUE(scene.follow(frame({1, 2, 3})));
  EXPECT_FALSE(scene.follow(nothing));
  EXPECT_EQ(target("g1"), Vec3(1, 2, 3));
}

TEST_F(Follow, EachSensorMovesItsOwn) {
  ASSERT_TRUE(scene.set_goal(goal_edit("g2", "left_hand"), {}));
  bind(binding_edit("b1", "g1"));
  bind(binding_edit("b2", "g2", "simulated:2"));
  Frame both = frame({1, 1, 1});
  both.samples.push_back(frame({2, 2, 2}, 2).samples[0]);
  EXPECT_TRUE(scene.follow(both));
  EXPECT_EQ(target("g1"), Vec3(1, 1, 1));
  EXPECT_EQ(target("g2"), Vec3(2, 2, 2));
}

TEST_F(Follow, DoesNotAllocate) {
  ASSERT_TRUE(scene.set_goal(goal_edit("a-goal-with-a-name-that-no-small-string-holds", "left_hand"), {}));
  bind(binding_edit("b1", "g1"));
  BindingEdit relative = binding_edit("b2", "a-goal-with-a-name-that-no-small-string-holds", "simulated:2");
  relative.mode = Binding::Mode::relative;
  bind(relative);
  Frame both = frame({1, 1, 1});
  both.samples.push_back(frame({2, 2, 2}, 2).samples[0]);
  const std::size_t before = test::allocation_count();
  EXPECT_GT(before, 0u);
  const bool moved = scene.follow(both).pose;
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_TRUE(moved);
}

}  // namespace
}  // namespace posed
