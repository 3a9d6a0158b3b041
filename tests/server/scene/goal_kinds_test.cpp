// Goals of every kind: what edits make of them, what is refused, and what the solver is given.
#include "server/scene/spring_goals.h"
#include "tests/server/scene/scene_fixture.h"

namespace posed {
namespace {

class GoalKinds : public SceneTest {
 protected:
  static GoalEdit at(const std::string& segment) {
    GoalEdit edit;
    if (!segment.empty()) edit.at = Attachment{segment, {}, ""};
    return edit;
  }
  // One of every kind, without an id.
  static std::vector<GoalEdit> one_of_each() {
    std::vector<GoalEdit> edits(9, at("right_hand"));
    edits[0].position = Vec3(1, 2, 3);
    edits[1].orientation = OrientationTarget{kTurn};
    edits[2].position = Vec3(1, 2, 3);
    edits[2].orientation = OrientationTarget{kTurn};
    edits[3].aim = AimTarget{{0, 0, 2}, Vec3(1, 0, 1), {}};
    edits[4].plane = PlaneTarget{{0, 0, 1}, {0, 0, 4}, PlaneTarget::Side::above};
    edits[5].line = LineTarget{{0, 0, 1}, {0, -3, 0}};
    edits[6].distance = DistanceTarget{{"head", {}, "eyes"}, 0.3, DistanceTarget::Compare::at_most};
    edits[7] = at("");
    edits[7].balance = BalanceTarget{{{"left_foot", {}, ""}, {"right_foot", {}, ""}}, 0.02};
    edits[8] = at("");
    edits[8].posture = PostureTarget{"", {{"left_elbow", {{}, {}, 1.2, {}}}}};
    return edits;
  }
  std::string set(const GoalEdit& edit) {
    const Result<Edited> edited = scene.set_goal(edit, {});
    EXPECT_TRUE(edited) << edited.error().path << " " << edited.error().message;
    return edited ? edited->id : "";
  }
  SpringGoal spring(const std::string& id) const { return spring_goal(scene.goals().at(id)); }
  int segment(const char* name) const { return *scene.figures().at("body").tree->find_segment(name); }
  template <class T>
  void refuse(GoalEdit edit, const char* code, const char* path, T change) {
    edit.id = "g";
    change(edit);
    expect_refused(code, path, [&] { return scene.set_goal(edit, {}); });
  }

  inline static const Quat kTurn = quat_from_xyzw(0.5, 0.5, 0.5, 0.5);
};

TEST_F(GoalKinds, WithoutAnIdTheKindNamesTheGoal) {
  std::vector<std::string> ids;
  for (const GoalEdit& edit : one_of_each()) ids.push_back(set(edit));
  EXPECT_EQ(ids,
            (std::vector<std::string>{"body.right_hand.position", "body.right_hand.orientation", "body.right_hand.pose",
                                      "body.right_hand.aim", "body.right_hand.plane", "body.right_hand.line",
                                      "body.right_hand.distance", "body.balance", "body.posture"}));
  for (const GoalEdit& edit : one_of_each()) set(edit);
  EXPECT_EQ(scene.goals().size(), 9u);
  // Said again without the payload, by the kind.
  GoalEdit heavier = at("right_hand");
  heavier.kind = GoalKind::aim;
  heavier.weight = 40.0;
  EXPECT_EQ(set(heavier), "body.right_hand.aim");
  EXPECT_EQ(goal("body.right_hand.aim").weight, 40.0);
}

TEST_F(GoalKinds, BecomeSpringsWithResolvedNamesAndUnitDirections) {
  std::vector<SpringGoal> springs;
  for (const GoalEdit& edit : one_of_each()) springs.push_back(spring(set(edit)));
  const BodyTree& tree = *scene.figures().at("body").tree;
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(springs[static_cast<std::size_t>(i)].at.segment, segment("right_hand"));
    EXPECT_EQ(springs[static_cast<std::size_t>(i)].at.point, tree.segment(segment("right_hand")).touch_point);
  }
  EXPECT_EQ(std::get<PositionSpring>(springs[0].spring).position, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<OrientationSpring>(springs[1].spring).rotation, kTurn);
  EXPECT_EQ(std::get<PoseSpring>(springs[2].spring).position, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<PoseSpring>(springs[2].spring).rotation, kTurn);
  EXPECT_EQ(std::get<AimSpring>(springs[3].spring).axis, kZ);
  EXPECT_TRUE(std::get<AimSpring>(springs[3].spring).at_point);
  EXPECT_EQ(std::get<PlaneSpring>(springs[4].spring).normal, kZ);
  EXPECT_TRUE(std::get<PlaneSpring>(springs[4].spring).above);
  EXPECT_EQ(std::get<LineSpring>(springs[5].spring).direction, -kY);
  const auto& distance = std::get<DistanceSpring>(springs[6].spring);
  EXPECT_EQ(distance.to.segment, segment("head"));
  EXPECT_EQ(distance.to.point, tree.document().sites.at("head/eyes").point);
  EXPECT_EQ(distance.compare, DistanceSpring::Compare::at_most);
  const auto& posture = std::get<PostureSpring>(springs[8].spring);
  EXPECT_EQ(posture.joints, std::vector<int>{*tree.find_joint("left_elbow")});
  ASSERT_EQ(posture.values.size(), 4u);
  EXPECT_NEAR(posture.values[3], std::cos(0.6), 1e-12);
  for (const SpringGoal& goal : springs) {
    EXPECT_EQ(goal.base_segment, -1);
    EXPECT_EQ(goal.weight, 10.0);
    EXPECT_TRUE(pulls(goal));
  }
}

TEST_F(GoalKinds, FeetSupportWithTheirSoles) {
  const SpringGoal goal = spring(set(one_of_each()[7]));
  const auto& balance = std::get<BalanceSpring>(goal.spring);
  ASSERT_EQ(balance.support.size(), 8u);
  for (const AttachedPoint& p : balance.support) EXPECT_NEAR(p.point.z, -0.039 * 1.75, 1e-12);
  EXPECT_NE(balance.support[0].point.y, balance.support[2].point.y);
  EXPECT_EQ(balance.support[4].segment, segment("right_foot"));
  // A point, a site, and a segment without a box stand for themselves.
  GoalEdit edit = at("");
  edit.balance = BalanceTarget{{{"left_foot", Vec3(0, 0, 0), ""}, {"left_foot", {}, "heel"}, {"neck", {}, ""}}, 0.0};
  const SpringGoal points = spring(set(edit));
  EXPECT_EQ(std::get<BalanceSpring>(points.spring).support.size(), 3u);
}

// Points beyond the sixteenth did not count, and nobody was told.
TEST_F(GoalKinds, SupportsOfManyPointsAllCountOrAreRefused) {
  GoalEdit edit = at("");
  edit.balance = BalanceTarget{std::vector<Attachment>(16, {"left_foot", {}, ""}), 0.0};
  const SpringGoal goal = spring(set(edit));
  EXPECT_EQ(std::get<BalanceSpring>(goal.spring).support.size(), 64u);
  edit.balance->support.push_back({"right_foot", {}, ""});
  expect_refused("out_of_range", "/balance/support", [&] { return scene.set_goal(edit, {}); });
}

TEST_F(GoalKinds, APostureOfTheWholeBodyLeavesTheRootAlone) {
  GoalEdit edit = at("");
  edit.posture = PostureTarget{"rest", {}};
  const auto spring_of = spring(set(edit));
  const auto& rest = std::get<PostureSpring>(spring_of.spring);
  EXPECT_EQ(rest.joints.size(), 17u);
  EXPECT_EQ(rest.joints[0], 1);
  EXPECT_EQ(rest.values.size(), 17u * 4u);
}

TEST_F(GoalKinds, AnotherKindsPayloadChangesTheKind) {
  GoalEdit edit = one_of_each()[0];
  edit.id = "g";
  edit.weight = 3.0;
  expect_edited("g", 1, [&] { return scene.set_goal(edit, {}); });
  GoalEdit aim;
  aim.id = "g";
  aim.aim = AimTarget{{1, 0, 0}, {}, Vec3(0, 0, 1)};
  expect_edited("g", 2, [&] { return scene.set_goal(aim, {}); });
  EXPECT_EQ(kind_of(goal("g").payload), GoalKind::aim);
  EXPECT_EQ(goal("g").at.segment, "right_hand");
  EXPECT_EQ(goal("g").weight, 3.0);
  GoalEdit posture = one_of_each()[8];
  posture.id = "g";
  set(posture);
  EXPECT_TRUE(goal("g").at.empty());
  refuse(one_of_each()[0], "missing_field", "/at", [](GoalEdit& e) { e.at.reset(); });
}

TEST_F(GoalKinds, HalfOfAPoseMovesThePose) {
  GoalEdit edit = one_of_each()[2];
  edit.id = "g";
  GoalWeight weight = 5.0;
  weight.orientation = 2.0;
  edit.weight = weight;
  set(edit);
  EXPECT_EQ(spring("g").weight, 5.0);
  EXPECT_EQ(spring("g").orientation_weight, 2.0);
  GoalEdit move;
  move.id = "g";
  move.position = Vec3(3, 2, 1);
  set(move);
  ASSERT_EQ(kind_of(goal("g").payload), GoalKind::pose);
  EXPECT_EQ(std::get<PoseTarget>(goal("g").payload).rotation, kTurn);
  EXPECT_EQ(position("g"), Vec3(3, 2, 1));
  // The kind has the last word.
  GoalEdit drop;
  drop.id = "g";
  drop.kind = GoalKind::position;
  set(drop);
  EXPECT_EQ(kind_of(goal("g").payload), GoalKind::position);
  EXPECT_EQ(position("g"), Vec3(3, 2, 1));
  EXPECT_FALSE(goal("g").weight.orientation);
  GoalEdit turn;
  turn.id = "g";
  turn.kind = GoalKind::pose;
  turn.orientation = OrientationTarget{kTurn};
  set(turn);
  EXPECT_EQ(kind_of(goal("g").payload), GoalKind::pose);
}

TEST_F(GoalKinds, TwoKindsAreAnErrorThatNamesBoth) {
  GoalEdit both = one_of_each()[3];
  both.id = "g";
  both.line = LineTarget{};
  const auto result = scene.set_goal(both, {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().path, "/line");
  EXPECT_NE(result.error().message.find("aim and line"), std::string::npos);
  refuse(one_of_each()[2], "invalid_params", "/plane", [](GoalEdit& e) { e.plane = PlaneTarget{}; });
  refuse(one_of_each()[3], "invalid_params", "/kind", [](GoalEdit& e) { e.kind = GoalKind::pose; });
  refuse(one_of_each()[0], "missing_field", "/orientation", [](GoalEdit& e) { e.kind = GoalKind::pose; });
  refuse(at("head"), "missing_field", "/aim", [](GoalEdit& e) { e.kind = GoalKind::aim; });
  GoalEdit agrees = one_of_each()[3];
  agrees.kind = GoalKind::aim;
  set(agrees);
}

TEST_F(GoalKinds, ChecksEveryNumberAndName) {
  const auto kinds = one_of_each();
  const double nan = std::nan("");
  refuse(kinds[0], "out_of_range", "/position/0", [&](GoalEdit& e) { e.position->x = nan; });
  refuse(kinds[1], "invalid_params", "/orientation/quat_xyzw", [](GoalEdit& e) { e.orientation->rotation.w = 2; });
  refuse(kinds[1], "invalid_params", "/orientation/quat_xyzw", [&](GoalEdit& e) { e.orientation->rotation.w = nan; });
  refuse(kinds[3], "out_of_range", "/aim/axis", [](GoalEdit& e) { e.aim->axis = kZero; });
  refuse(kinds[3], "out_of_range", "/aim/point/2", [](GoalEdit& e) { e.aim->point->z = 1e7; });
  refuse(kinds[3], "invalid_params", "/aim/direction", [](GoalEdit& e) { e.aim->direction = kX; });
  refuse(kinds[3], "missing_field", "/aim/point", [](GoalEdit& e) { e.aim->point.reset(); });
  refuse(kinds[4], "out_of_range", "/plane/normal", [](GoalEdit& e) { e.plane->normal = kZero; });
  refuse(kinds[4], "out_of_range", "/plane/point/1", [&](GoalEdit& e) { e.plane->point.y = nan; });
  refuse(kinds[5], "out_of_range", "/line/direction/0", [&](GoalEdit& e) { e.line->direction.x = nan; });
  refuse(kinds[6], "out_of_range", "/distance/length", [](GoalEdit& e) { e.distance->length = -1; });
  refuse(kinds[6], "unknown_site", "/distance/to", [](GoalEdit& e) { e.distance->to.site = "eye"; });
  refuse(kinds[7], "out_of_range", "/balance/support", [](GoalEdit& e) { e.balance->support.clear(); });
  refuse(kinds[7], "unknown_segment", "/balance/support/1",
         [](GoalEdit& e) { e.balance->support[1].segment = "left_fot"; });
  refuse(kinds[7], "out_of_range", "/balance/margin", [](GoalEdit& e) { e.balance->margin = -0.1; });
  refuse(kinds[8], "unknown_joint", "/posture/joints/left_knie", [](GoalEdit& e) {
    e.posture->joints["left_knie"] = {{0, 0, 0, 1}, {}, {}, {}};
  });
  refuse(kinds[8], "wrong_type", "/posture/joints/left_knee", [](GoalEdit& e) {
    e.posture->joints["left_knee"] = {{1}, {}, {}, {}};
  });
  refuse(kinds[8], "out_of_range", "/posture/joints/left_knee/deviation", [](GoalEdit& e) {
    e.posture->joints["left_knee"] = {{}, {}, 4.0, {}};
  });
  refuse(kinds[8], "invalid_params", "/posture/joints/root", [](GoalEdit& e) {
    e.posture->joints["root"] = {{0, 0, 0, 0, 0, 0, 1}, {}, {}, {}};
  });
  refuse(kinds[8], "invalid_params", "/posture/pose", [](GoalEdit& e) { e.posture = PostureTarget{"sitting", {}}; });
  refuse(kinds[8], "missing_field", "/posture/pose", [](GoalEdit& e) { e.posture = PostureTarget{}; });
  refuse(kinds[0], "out_of_range", "/priority", [](GoalEdit& e) { e.priority = 101; });
  refuse(kinds[0], "invalid_params", "/weight", [](GoalEdit& e) {
    GoalWeight w;
    w.orientation = 1.0;
    e.weight = w;
  });
  refuse(kinds[7], "invalid_params", "/at", [](GoalEdit& e) { e.at = Attachment{"head", {}, ""}; });
  refuse(kinds[3], "missing_field", "/at", [](GoalEdit& e) { e.at.reset(); });
}

TEST_F(GoalKinds, MayBeRelativeToASegment) {
  GoalEdit edit = one_of_each()[0];
  edit.id = "g";
  edit.relative_to = GoalBase{GoalBase::Kind::segment, "", "hips", ""};
  refuse(edit, "unknown_segment", "/relative_to/segment", [](GoalEdit& e) {
    e.relative_to = GoalBase{GoalBase::Kind::segment, "", "hat", ""};
  });
  set(edit);
  EXPECT_EQ(goal("g").relative_to.figure, "body");
  EXPECT_EQ(spring("g").base_segment, segment("lower_torso"));
  EXPECT_FALSE(joins_figures(scene.goals().at("g")));
  refuse(edit, "unknown_figure", "/relative_to/figure", [](GoalEdit& e) {
    e.relative_to = GoalBase{GoalBase::Kind::segment, "chair", "seat", ""};
  });
  refuse(one_of_each()[8], "invalid_params", "/relative_to", [&](GoalEdit& e) { e.relative_to = edit.relative_to; });
  expect_refused("not_available", "/to/goal", [&] { return scene.set_binding(binding_edit("b", "g"), {}); });
}

TEST_F(GoalKinds, MayBeRelativeToAnotherFigure) {
  ASSERT_TRUE(scene.set_figure(small_entry("other"), {}));
  GoalEdit edit = one_of_each()[0];
  edit.id = "g";
  edit.figure = "body";
  edit.relative_to = GoalBase{GoalBase::Kind::segment, "other", "tip", ""};
  set(edit);
  const SceneGoal& made = scene.goals().at("g");
  EXPECT_TRUE(joins_figures(made));
  EXPECT_EQ(made.base_segment, 1);
  const SpringGoal goal = spring_goal(made, {{1, 1, 1}, kTurn});
  EXPECT_EQ(goal.base_segment, -1);
  EXPECT_EQ(goal.world_from_base.position, Vec3(1, 1, 1));
  // The other figure may not lose the segment, and takes the goal along when it goes.
  expect_refused("unknown_segment", "/id", [&] { return scene.set_figure(small_entry("other", "top"), {}); });
  EXPECT_TRUE(scene.set_figure(small_entry("other"), {}));
  ASSERT_TRUE(scene.remove_figure("other", {}));
  EXPECT_TRUE(scene.goals().empty());
}

TEST_F(GoalKinds, MayBeRelativeToASensor) {
  GoalEdit edit = one_of_each()[0];
  edit.id = "g";
  edit.relative_to = GoalBase{GoalBase::Kind::sensor, "", "", "simulated:2"};
  refuse(edit, "unknown_sensor", "/relative_to/sensor", [](GoalEdit& e) {
    e.relative_to = GoalBase{GoalBase::Kind::sensor, "", "", "simulated"};
  });
  set(edit);
  EXPECT_FALSE(pulls(spring("g"))) << "nobody knows where the sensor is";
  Frame heard = frame({4, 5, 6}, 2);
  heard.samples[0].rotation = kTurn;
  const Revision before = scene.revision();
  EXPECT_TRUE(scene.follow(heard));
  EXPECT_FALSE(scene.follow(heard));
  EXPECT_FALSE(scene.follow(frame({1, 1, 1}, 1)));
  EXPECT_EQ(scene.revision(), before);
  SpringGoal goal = spring("g");
  EXPECT_TRUE(pulls(goal));
  EXPECT_EQ(goal.world_from_base.position, Vec3(4, 5, 6));
  EXPECT_EQ(goal.world_from_base.rotation, kTurn);
  heard.samples[0].position.x = 0;
  EXPECT_TRUE(scene.follow(heard));
  follow_sensors(scene.goals().at("g"), goal);
  EXPECT_EQ(goal.world_from_base.position, Vec3(0, 5, 6));
  // An edit that leaves the sensor keeps what it said.
  GoalEdit move;
  move.id = "g";
  move.position = Vec3(0, 0, 0);
  set(move);
  EXPECT_EQ(spring("g").world_from_base.position, Vec3(0, 5, 6));
}

TEST_F(GoalKinds, SensorsMoveThePositionOfAPoseWhereNoMoreIsAsked) {
  GoalEdit edit = one_of_each()[2];
  edit.id = "g";
  set(edit);
  BindingEdit moves = binding_edit("b", "g");
  moves.axes = kMoves;
  ASSERT_TRUE(scene.set_binding(moves, {}));
  EXPECT_TRUE(scene.follow(frame({7, 8, 9})));
  const SpringGoal pose = spring("g");
  EXPECT_EQ(std::get<PoseSpring>(pose.spring).position, Vec3(7, 8, 9));
  EXPECT_EQ(std::get<PoseSpring>(pose.spring).rotation, kTurn);
  refuse(one_of_each()[3], "invalid_params", "/aim", [](GoalEdit&) {});
  refuse(one_of_each()[2], "not_available", "/relative_to", [](GoalEdit& e) {
    e.relative_to = GoalBase{GoalBase::Kind::segment, "", "head", ""};
  });
  ASSERT_TRUE(scene.remove_binding("b", {}));
  EXPECT_EQ(position("g"), Vec3(7, 8, 9));
  EXPECT_EQ(std::get<PoseSpring>(spring("g").spring).position, Vec3(7, 8, 9));
  GoalEdit aim = one_of_each()[3];
  aim.id = "look";
  set(aim);
  expect_refused("invalid_params", "/to/goal", [&] { return scene.set_binding(binding_edit("b", "look"), {}); });
}

}  // namespace
}  // namespace posed
