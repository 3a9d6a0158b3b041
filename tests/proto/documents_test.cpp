// Figures and scenes as text, and patches between texts.
#include <fstream>
#include <iterator>
#include <random>

#include "server/scene/scene.h"
#include "server/solver/tempus.h"
#include "tests/proto/proto_fixture.h"

namespace posed::proto {
namespace {

SceneDocument rich_scene() {
  SceneDocument scene;
  FigureEntry body;
  body.template_name = "tempus";
  body.stature = 1.0 / 3.0;
  body.q = {0.1, 1e-17, -1.0 / 3.0};
  body.label = "Ana";
  body.user = R"({"z":1,"a":[2]})";
  scene.figures["body"] = body;
  FigureEntry own;
  own.document = *tempus(1.8);
  scene.figures["own"] = own;
  Goal goal;
  goal.figure = "body";
  goal.at = {"right_hand", Vec3(0.1, 0.2, 0.3), ""};
  goal.payload = PositionTarget{{1.0 / 3.0, 2e-8, -5}};
  goal.weight = 0.1;
  goal.tolerance = 0.7;
  goal.enabled = false;
  goal.user = "null";
  scene.goals["g1"] = goal;
  Object object;
  object.world_from_object = {{1.0 / 3.0, 2e-8, -5}, glm::normalize(Quat(0.1, 0.2, -0.3, 0.4))};
  object.shapes = {{Shape::Kind::capsule, {0, 0, 0}, {0, 0, 1}, 0.1}};
  object.label = "blue";
  scene.objects["chair"] = object;
  Binding carrying;
  carrying.sensor = "liberty:3";
  carrying.to = BindingTarget{"", "chair", "", "", ""};
  carrying.axes = kAllAxes;
  carrying.clutch = Clutch{1};
  carrying.buttons = {{0, ButtonAction::Do::save}, {2, ButtonAction::Do::toggle}};
  carrying.offset = SensorOffset{{0.1, 0, 1.0 / 3.0}, quat_from_xyzw(0.5, 0.5, 0.5, 0.5)};
  carrying.filter = BindingFilter{OneEuro{0.5, 3.0, 2.0}, 12.5};
  Camera camera;
  camera.base_from_camera = {{0.1, 1.0 / 3.0, 0}, quat_from_xyzw(0.5, 0.5, 0.5, 0.5)};
  camera.relative_to = {GoalBase::Kind::object, "", "", "", "chair"};
  camera.fov_y = 0.7;
  camera.user = "[2]";
  scene.cameras["main"] = camera;
  scene.bindings["b2"] = carrying;
  Binding binding;
  binding.sensor = "liberty:2";
  binding.to = BindingTarget{"g1", "", "", "", ""};
  binding.axes = Axes{false, true, false};
  binding.mode = Binding::Mode::relative;
  binding.scale = -0.1;
  scene.bindings["b1"] = binding;
  return scene;
}

TEST(Documents, AFigureComesBackToTheLastDigit) {
  std::mt19937 random{11};
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i) {
    FigureDocument figure = *tempus(1.0 + 0.05 * i);
    for (Segment& s : figure.segments) {
      s.touch_point = {normal(random), 1e-9 * normal(random), 1e9 * normal(random)};
      s.joint.parent_from_joint.rotation =
          glm::normalize(Quat(normal(random), normal(random), normal(random), normal(random)));
      s.mass = std::abs(normal(random));
    }
    const std::string text = encode_figure(figure);
    const Result<FigureDocument> back = decode_figure(text);
    ASSERT_TRUE(back) << back.error().message << back.error().path;
    EXPECT_EQ(encode_figure(*back), text);
    for (std::size_t s = 0; s < figure.segments.size(); ++s) {
      EXPECT_EQ(back->segments[s].touch_point, figure.segments[s].touch_point);
      EXPECT_EQ(back->segments[s].mass, figure.segments[s].mass);
      EXPECT_EQ(back->segments[s].joint.limits.size(), figure.segments[s].joint.limits.size());
      EXPECT_EQ(back->segments[s].joint.bend_axis, figure.segments[s].joint.bend_axis);
    }
    EXPECT_EQ(back->aliases, figure.aliases);
    EXPECT_EQ(back->mirror, figure.mirror);
    EXPECT_EQ(back->sites.size(), figure.sites.size());
  }
}

TEST(Documents, ASceneComesBackToTheLastDigit) {
  const SceneDocument scene = rich_scene();
  const std::string text = encode_scene(scene);
  const Result<SceneDocument> back = decode_scene(text);
  ASSERT_TRUE(back) << back.error().message << back.error().path;
  EXPECT_EQ(encode_scene(*back), text);
  EXPECT_EQ(back->figures.at("body").q, scene.figures.at("body").q);
  EXPECT_EQ(back->figures.at("body").user, scene.figures.at("body").user);
  EXPECT_EQ(*position_of(back->goals.at("g1").payload), *position_of(scene.goals.at("g1").payload));
  EXPECT_EQ(back->goals.at("g1").at, scene.goals.at("g1").at);
  EXPECT_FALSE(back->goals.at("g1").enabled);
  EXPECT_EQ(back->goals.at("g1").user, "null");
  EXPECT_FALSE(back->bindings.at("b1").axes->x);
  EXPECT_EQ(back->bindings.at("b1").scale, -0.1);
  // Set out for reading it is the same document.
  EXPECT_EQ(encode_scene(*decode_scene(encode_scene(scene, 2))), text);
}

TEST(Documents, GoalsOfEveryKindComeBack) {
  const Quat turned = quat_from_xyzw(0.5, 0.5, 0.5, 0.5);
  const GoalPayload payloads[] = {
      PositionTarget{{1, 2, 1.0 / 3.0}},
      OrientationTarget{turned},
      PoseTarget{{1, 2, 3}, turned},
      AimTarget{{0, 0, 2}, {}, Vec3(1, 0, 0)},
      PlaneTarget{{0, 0, 1}, {0, 1, 1}, PlaneTarget::Side::above},
      LineTarget{{0, 0, 1}, {0, 1, 0}},
      DistanceTarget{{"head", {}, "eyes"}, 0.3, DistanceTarget::Compare::at_most},
      BalanceTarget{{{"left_foot", {}, ""}, {"right_foot", Vec3(0, 0, 1), ""}}, 0.02},
      PostureTarget{"", {{"left_elbow", {{}, {}, 1.2, {}}}, {"waist", {{0, 0, 0, 1}, {}, {}, {}}}}}};
  for (const GoalPayload& payload : payloads) {
    SceneDocument scene;
    Goal& goal = scene.goals["g"];
    goal.figure = "body";
    goal.payload = payload;
    if (takes_hold(kind_of(payload))) goal.at.segment = "head";
    goal.relative_to = {GoalBase::Kind::segment, "body", "head", ""};
    goal.weight.orientation = 0.5;
    goal.priority = -2;
    const std::string text = encode_scene(scene);
    EXPECT_NE(text.find(std::string("\"kind\":\"") + name_of(kind_of(payload)) + '"'), std::string::npos) << text;
    const Result<SceneDocument> back = decode_scene(text);
    ASSERT_TRUE(back) << back.error().path << back.error().message;
    EXPECT_EQ(encode_scene(*back), text);
    EXPECT_EQ(back->goals.at("g").payload.index(), payload.index());
    EXPECT_EQ(back->goals.at("g").relative_to, goal.relative_to);
    EXPECT_EQ(back->goals.at("g").weight, goal.weight);
  }
}

TEST(Documents, PinsSwingAndTwistComeBack) {
  SceneDocument scene;
  FigureEntry& body = scene.figures["body"];
  body.document = *tempus(1.75);
  body.pins["left_foot"] = {Pin::Hold::pose, Vec3(0, 0.1, 0), quat_from_xyzw(0, 0, 1, 0)};
  body.pins["head"] = {Pin::Hold::orientation, {}, {}};
  Joint& joint = body.document->segments[1].joint;
  joint.limits.clear();
  joint.swing = Swing{Swing::Kind::ellipse, kZ, {0.8, 0.5}, {}};
  joint.twist = Limit{-1, 0.5};
  body.document->segments[2].joint.swing = Swing{Swing::Kind::polygon, kZero, {}, {kX, kY, kZ}};
  const std::string text = encode_scene(scene);
  EXPECT_NE(text.find(R"("swing":{"ellipse":[0.8,0.5],"center":[0.0,0.0,1.0]},"twist":[-1.0,0.5])"), std::string::npos);
  EXPECT_NE(text.find(R"("pins":{"head":{"hold":"orientation"},"left_foot":{"hold":"pose","position":[0.0,0.1,0.0],)"),
            std::string::npos);
  EXPECT_EQ(encode_scene(*decode_scene(text)), text);
}

TEST(Documents, TheKeysAreTheIds) {
  const Result<SceneDocument> scene = decode_scene(encode_scene(rich_scene()));
  EXPECT_EQ(scene->figures.at("own").id, "own");
  EXPECT_EQ(scene->goals.at("g1").id, "g1");
  EXPECT_EQ(scene->bindings.at("b1").id, "b1");
}

TEST(Documents, WhatIsWrongIsToldWithItsPath) {
  const std::string good = encode_scene(rich_scene());
  const auto broken = [&](const char* patch, const char* code, const char* path) {
    const Result<SceneDocument> scene = decode_scene(json::parse(good).patch(json::parse(patch)).dump());
    ASSERT_FALSE(scene) << patch;
    EXPECT_EQ(scene.error().code, code) << scene.error().message;
    EXPECT_EQ(scene.error().path, path) << scene.error().message;
  };
  broken(R"([{"op":"replace","path":"/format","value":"posed.scene/2"}])", "bad_scene", "/format");
  broken(R"([{"op":"remove","path":"/goals"}])", "bad_scene", "/goals");
  broken(R"([{"op":"add","path":"/extra","value":1}])", "bad_scene", "/extra");
  broken(R"([{"op":"replace","path":"/goals/g1/weight","value":"x"}])", "bad_scene", "/goals/g1/weight");
  broken(R"([{"op":"add","path":"/goals/g1/priority","value":1.5}])", "bad_scene", "/goals/g1/priority");
  broken(R"([{"op":"add","path":"/objects/chair","value":{}}])", "bad_scene", "/objects/chair/position");
  broken(R"([{"op":"replace","path":"/figures/own/document/segments/3/joint/type","value":"knot"}])", "bad_scene",
         "/figures/own/document/segments/3/joint/type");
  EXPECT_EQ(decode_scene("{").error().code, "parse_error");
  EXPECT_EQ(decode_figure("[]").error().code, "bad_figure");
  EXPECT_EQ(decode_figure(R"({"format":"posed.figure/2","root":"a","segments":[]})").error().path, "/format");
}

TEST(Documents, PatchesLeadFromOneToTheOther) {
  std::vector<std::string> texts{"{}", encode_scene({}), encode_scene(rich_scene())};
  SceneDocument scene = rich_scene();
  scene.goals["g2"] = scene.goals["g1"];
  scene.goals["g2"].label = "a/b~c";
  texts.push_back(encode_scene(scene));
  scene.goals.erase("g1");
  scene.bindings["b1"].to.goal = "g2";
  scene.figures["body"].q = {0.2};
  texts.push_back(encode_scene(scene));
  scene.figures.erase("own");
  scene.figures["body"].label.clear();
  texts.push_back(encode_scene(scene));
  for (const std::string& before : texts) {
    for (const std::string& after : texts) {
      const json patch = json::parse(diff(before, after));
      EXPECT_EQ(json::parse(before).patch(patch), json::parse(after)) << patch;
      EXPECT_EQ(patch.empty(), json::parse(before) == json::parse(after));
    }
  }
}

TEST(Documents, APatchIsSmall) {
  SceneDocument scene = rich_scene();
  const std::string before = encode_scene(scene);
  position_of(scene.goals["g1"].payload)->x = 0.5;
  EXPECT_EQ(diff(before, encode_scene(scene)), R"([{"op":"replace","path":"/goals/g1/position/0","value":0.5}])");
}

}  // namespace
}  // namespace posed::proto
