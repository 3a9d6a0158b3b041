#include "tests/server/scene/scene_fixture.h"

namespace posed {
namespace {

class BindingEdits : public SceneTest {
 protected:
  BindingEdits() {
    EXPECT_TRUE(scene.set_goal(goal_edit("g1"), {}));
    EXPECT_TRUE(scene.set_goal(goal_edit("g2", "left_hand"), {}));
  }
};

TEST_F(BindingEdits, WithoutAnIdTheSensorNamesIt) {
  expect_edited("simulated.1", 1, [&] { return scene.set_binding(binding_edit("", "g1"), {}); });
  const SceneBinding& made = scene.bindings().at("simulated.1");
  EXPECT_EQ(made.sensor.device, "simulated");
  EXPECT_EQ(made.sensor.station, 1);
  EXPECT_EQ(made.binding.mode, Binding::Mode::absolute);
  EXPECT_EQ(made.binding.scale, 1.0);
}

TEST_F(BindingEdits, OnlyTheNamedFieldsChangeAndNullRestores) {
  BindingEdit first = binding_edit("b1", "g1");
  first.axes = Axes{true, false, false};
  first.mode = Binding::Mode::relative;
  first.scale = 2.0;
  first.label = std::string("wand");
  expect_edited("b1", 1, [&] { return scene.set_binding(first, {}); });
  BindingEdit retarget;
  retarget.id = "b1";
  retarget.to = BindingTarget{"g2", "", "", "", ""};
  expect_edited("b1", 2, [&] { return scene.set_binding(retarget, {}); });
  const Binding& kept = scene.bindings().at("b1").binding;
  EXPECT_EQ(kept.to.goal, "g2");
  EXPECT_FALSE(kept.axes->y);
  EXPECT_EQ(kept.mode, Binding::Mode::relative);
  EXPECT_EQ(kept.scale, 2.0);
  EXPECT_EQ(kept.label, "wand");

  BindingEdit null;
  null.id = "b1";
  null.axes = Patched<Axes>::reset();
  null.mode = Patched<Binding::Mode>::reset();
  null.scale = Patched<double>::reset();
  null.label = Patched<std::string>::reset();
  ASSERT_TRUE(scene.set_binding(null, {}));
  const Binding& restored = scene.bindings().at("b1").binding;
  EXPECT_TRUE(restored.axes->y);
  EXPECT_EQ(restored.mode, Binding::Mode::absolute);
  EXPECT_EQ(restored.scale, 1.0);
  EXPECT_EQ(restored.label, "");
}

TEST_F(BindingEdits, ANewBindingNeedsASensorAndAGoal) {
  expect_refused("missing_field", "/sensor", [&] { return scene.set_binding({}, {}); });
  BindingEdit no_sensor = binding_edit("b1", "g1");
  no_sensor.sensor.reset();
  expect_refused("missing_field", "/sensor", [&] { return scene.set_binding(no_sensor, {}); });
  BindingEdit no_goal = binding_edit("b1", "g1");
  no_goal.to.reset();
  expect_refused("missing_field", "/to", [&] { return scene.set_binding(no_goal, {}); });
  expect_refused("unknown_goal", "/to/goal", [&] { return scene.set_binding(binding_edit("b1", "g9"), {}); });
}

TEST_F(BindingEdits, ASensorIsADeviceAndAStation) {
  for (const char* bad : {"simulated", "simulated:", ":1", "simulated:0", "simulated:257", "simulated:1x",
                          "simulated:-1", "simulated:99999999999", "sim ulated:1", "a:b:1"}) {
    SCOPED_TRACE(bad);
    expect_refused("unknown_sensor", "/sensor", [&] { return scene.set_binding(binding_edit("b1", "g1", bad), {}); });
    expect_refused("unknown_sensor", "/sensor", [&] { return scene.set_binding(binding_edit("", "g1", bad), {}); });
  }
  EXPECT_TRUE(scene.set_binding(binding_edit("b1", "g1", "my-liberty.2:256"), {}));
}

TEST_F(BindingEdits, NumbersHaveRangesAndIdsAnAlphabet) {
  expect_refused("bad_id", "/id", [&] { return scene.set_binding(binding_edit("a b", "g1"), {}); });
  for (const double bad : {1001.0, -1001.0, std::nan("")}) {
    BindingEdit edit = binding_edit("b1", "g1");
    edit.scale = bad;
    expect_refused("out_of_range", "/scale", [&] { return scene.set_binding(edit, {}); });
  }
}

TEST_F(BindingEdits, OneSensorMovesOneGoal) {
  ASSERT_TRUE(scene.set_binding(binding_edit("b1", "g1"), {}));
  expect_refused("invalid_params", "/to/goal",
                 [&] { return scene.set_binding(binding_edit("b2", "g1", "simulated:2"), {}); });
  ASSERT_TRUE(scene.set_binding(binding_edit("b2", "g2", "simulated:2"), {}));
  expect_refused("invalid_params", "/to/goal", [&] { return scene.set_binding(binding_edit("b2", "g1"), {}); });
}

TEST_F(BindingEdits, ComparesTheBindingsOwnRevision) {
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.set_binding(binding_edit("b1", "g1"), 1); });
  expect_edited("b1", 1, [&] { return scene.set_binding(binding_edit("b1", "g1"), 0); });
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.set_binding(binding_edit("b1", "g1"), 0); });
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.remove_binding("b1", nth("b1", 2)); });
  expect_edited("b1", 0, [&] { return scene.remove_binding("b1", nth("b1", 1)); });
  expect_refused("unknown_binding", "/id", [&] { return scene.remove_binding("b1", {}); });
}

TEST_F(BindingEdits, LettingGoLeavesTheGoalWhereTheSensorHadIt) {
  const Revision before = scene.goals().at("g1").revision;
  ASSERT_TRUE(scene.set_binding(binding_edit("b1", "g1"), {}));
  ASSERT_TRUE(scene.follow(frame({1, 2, 3})));
  ASSERT_NE(position("g1"), Vec3(1, 2, 3));
  expect_edited("b1", 0, [&] { return scene.remove_binding("b1", {}); });
  EXPECT_EQ(target("g1"), Vec3(1, 2, 3));
  EXPECT_EQ(position("g1"), Vec3(1, 2, 3));
  // Its document has changed, and whoever read it before must hear so.
  EXPECT_EQ(scene.goals().at("g1").revision, before + 1);
}

TEST_F(BindingEdits, LettingGoOfAGoalThatNeverMovedChangesNothingOfIt) {
  const Revision before = scene.goals().at("g1").revision;
  ASSERT_TRUE(scene.set_binding(binding_edit("b1", "g1"), {}));
  ASSERT_TRUE(scene.remove_binding("b1", {}));
  EXPECT_EQ(scene.goals().at("g1").revision, before);
}

TEST_F(BindingEdits, TakingAnotherGoalLetsGoOfTheFirst) {
  const Revision before = scene.goals().at("g1").revision;
  ASSERT_TRUE(scene.set_binding(binding_edit("b1", "g1"), {}));
  ASSERT_TRUE(scene.follow(frame({1, 2, 3})));
  ASSERT_TRUE(scene.set_binding(binding_edit("b1", "g2"), {}));
  EXPECT_EQ(target("g1"), Vec3(1, 2, 3));
  EXPECT_EQ(position("g1"), Vec3(1, 2, 3));
  EXPECT_EQ(scene.goals().at("g1").revision, before + 1);
}

}  // namespace
}  // namespace posed
