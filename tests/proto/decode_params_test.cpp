// What a method's parameters may say, and how it is told what is wrong with them.
#include "tests/proto/proto_fixture.h"

namespace posed::proto {
namespace {

TEST(DecodeParams, WrongTypesAreToldWithTheirPath) {
  expect_error(call("goal.set", R"({"position":[0,"x",0]})"), "wrong_type", "/params/position/1");
  expect_error(call("goal.set", R"({"position":[0,0]})"), "wrong_type", "/params/position");
  expect_error(call("goal.set", R"({"position":{"x":0}})"), "wrong_type", "/params/position");
  expect_error(call("goal.set", R"({"position":[0,null,0]})"), "wrong_type", "/params/position/1");
  expect_error(call("goal.set", R"({"weight":"10"})"), "wrong_type", "/params/weight");
  expect_error(call("goal.set", R"({"enabled":1})"), "wrong_type", "/params/enabled");
  expect_error(call("goal.set", R"({"id":7})"), "wrong_type", "/params/id");
  expect_error(call("goal.set", R"({"at":7})"), "wrong_type", "/params/at");
  expect_error(call("goal.set", R"({"at":{"segment":"head","point":[0,0,true]}})"), "wrong_type", "/params/at/point/2");
  expect_error(call("binding.set", R"({"to":"g1"})"), "wrong_type", "/params/to");
  expect_error(call("binding.set", R"({"axes":"xyz"})"), "wrong_type", "/params/axes");
  expect_error(call("binding.set", R"({"mode":1})"), "wrong_type", "/params/mode");
  expect_error(call("pose.set", R"({"q":[1,2,[3]]})"), "wrong_type", "/params/q/2");
  expect_error(call("stream.ack", R"({"stream":"pose","seq":1.5})"), "wrong_type", "/params/seq");
  expect_error(
      call("figure.set", R"({"id":"a","document":{"format":"posed.figure/1","root":"a","segments":[{"name":5}]}})"),
      "wrong_type", "/params/document/segments/0/name");
}

TEST(DecodeParams, WhatSensorsMayDo) {
  expect_error(call("binding.set", R"({"to":{}})"), "missing_field", "/params/to");
  expect_error(call("binding.set", R"({"to":{"goal":"g1","camera":"main"}})"), "invalid_params", "/params/to");
  expect_error(call("binding.set", R"({"to":{"goal":"g1","figure":"body"}})"), "invalid_params", "/params/to/figure");
  expect_error(call("binding.set", R"({"clutch":{"button":"left"}})"), "wrong_type", "/params/clutch/button");
  expect_error(call("binding.set", R"({"filter":{"euro":1}})"), "unknown_field", "/params/filter/euro");
  expect_error(call("joint.set", R"({"joint":"waist","hold":"yes"})"), "wrong_type", "/params/hold");
  expect_error(call("tracker.touch", R"({"sensor":"liberty:1","for_ms":0})"), "out_of_range", "/params/for_ms");
  expect_error(call("tracker.align", R"({"tracker":"liberty","points":[{"source":[0,0,0]}]})"), "missing_field",
               "/params/points/0/world");
  expect_error(call("tracker.configure", R"({"tracker":"liberty","position_filter":"strong"})"), "wrong_type",
               "/params/position_filter");
  EXPECT_TRUE(params_of<JointSet>("joint.set", R"({"joint":"waist","hold":false})").hold.is_reset());
  EXPECT_FALSE(params_of<JointSet>("joint.set", R"({"joint":"waist","hold":true})").hold.value()->weight);
  EXPECT_EQ(params_of<JointSet>("joint.set", R"({"joint":"waist","hold":3})").hold.value()->weight, 3.0);
}

TEST(DecodeParams, NumbersOutOfRange) {
  expect_error(call("stream.ack", R"({"stream":"pose","seq":-1})"), "out_of_range", "/params/seq");
  expect_error(call("solver.set", R"({"iterations":3000000000})"), "out_of_range", "/params/iterations");
  expect_error(call("pose.get", R"({"wait_ms":10001})"), "out_of_range", "/params/wait_ms");
  expect_error(call("pose.get", R"({"wait_ms":-1})"), "out_of_range", "/params/wait_ms");
  expect_error(call("stream.subscribe", R"({"stream":"pose","max_rate_hz":-1})"), "out_of_range",
               "/params/max_rate_hz");
  expect_error(call("stream.subscribe", R"({"stream":"pose","credit":1001})"), "out_of_range", "/params/credit");
  expect_error(call("goal.set", R"({"label":")" + std::string(4097, 'x') + R"("})"), "out_of_range", "/params/label");
  EXPECT_EQ(
      params_of<GoalSet>("goal.set", R"({"label":")" + std::string(4096, 'x') + R"("})").edit.label.value()->size(),
      4096u);
}

TEST(DecodeParams, MissingFields) {
  for (const char* method :
       {"goal.get", "goal.remove", "figure.get", "figure.set", "figure.remove", "binding.get", "binding.remove"}) {
    expect_error(call(method, "{}"), "missing_field", "/params/id");
    EXPECT_EQ(refused(call(method, "{}")).error.hint, "add \"id\"");
  }
  expect_error(call("joint.set", "{}"), "missing_field", "/params/joint");
  expect_error(call("pose.set", "{}"), "missing_field", "/params/q");
  expect_error(call("scene.open", "{}"), "missing_field", "/params/name");
  expect_error(call("stream.subscribe", "{}"), "missing_field", "/params/stream");
  expect_error(call("goal.set", R"({"at":{"segment":"head"}})"), "missing_field", "/params/at/point");
}

TEST(DecodeParams, UnknownFieldsAreToldWithTheNearest) {
  const BadRequest typo = refused(call("goal.set", R"({"at":"head","positon":[0,0,0]})"));
  EXPECT_EQ(typo.error.code, "unknown_field");
  EXPECT_EQ(typo.error.path, "/params/positon");
  EXPECT_EQ(typo.error.hint, "did you mean position?");
  expect_error(call("session.ping", R"({"a/b~c":1})"), "unknown_field", "/params/a~1b~0c");
  expect_error(call("goal.set", R"({"at":{"segment":"head","point":[0,0,0],"extra":1}})"), "unknown_field",
               "/params/at/extra");
  expect_error(call("binding.set", R"({"to":{"goal":"g","gaol":"g"}})"), "unknown_field", "/params/to/gaol");
  EXPECT_LT(refused(call("session.ping", R"({")" + std::string(100'000, 'x') + R"(":1})")).error.path.size(), 200u);
}

TEST(DecodeParams, EverySurplusFieldOfEveryMethodIsRefused) {
  for (const Params& message : every_message()) {
    json request = json::parse(encode_request(1, message));
    request["params"]["surplus"] = 1;
    expect_error(request.dump(), "unknown_field", "/params/surplus");
  }
}

TEST(DecodeParams, WordsThatAreNotKnown) {
  const BadRequest bad = refused(call("stream.subscribe", R"({"stream":"poses"})"));
  EXPECT_EQ(bad.error.code, "invalid_params");
  EXPECT_EQ(bad.error.path, "/params/stream");
  EXPECT_EQ(bad.error.hint, "one of: pose tracker scene stats camera");
  expect_error(call("binding.set", R"({"mode":"both"})"), "invalid_params", "/params/mode");
  expect_error(call("binding.set", R"({"axes":["x","w"]})"), "invalid_params", "/params/axes");
  expect_error(call("pose.reset", R"({"to":"sitting"})"), "invalid_params", "/params/to");
}

TEST(DecodeParams, WhatIsReservedIsNotAvailable) {
  expect_error(call("goal.set", R"({"scene":"other"})"), "not_available", "/params/scene");
  expect_error(call("session.hello", R"({"protocol":2})"), "not_available", "/params/protocol");
  expect_error(call("stream.subscribe", R"({"stream":"pose","encoding":"bson"})"), "invalid_params",
               "/params/encoding");
}

TEST(DecodeParams, WhatIsReservedMayBeSaidAsItIs) {
  params_of<GoalSet>("goal.set", R"({"aim":null,"scene":"main"})");
  EXPECT_EQ(params_of<StreamSubscribe>("stream.subscribe", R"({"stream":"pose","encoding":"cbor"})").encoding,
            Encoding::cbor);
}

TEST(DecodeParams, EveryMethodTakesTheScene) {
  for (const Params& message : every_message()) {
    json request = json::parse(encode_request(1, message));
    request["params"]["scene"] = "main";
    EXPECT_EQ(accepted(request.dump()).params.index(), message.index());
    request["params"]["scene"] = "other";
    expect_error(request.dump(), "not_available", "/params/scene");
  }
}

TEST(DecodeParams, OnlyEditsTakeIfRevision) {
  for (const Params& message : every_message()) {
    json request = json::parse(encode_request(1, message));
    request["params"]["if_revision"] = 7;
    const std::string method = request["method"];
    const bool edits = method.ends_with(".set")
                           ? method != "solver.set"
                           : (method.ends_with(".remove") && method != "scene.remove") || method == "pose.reset" ||
                                 method == "pose.mirror" || method == "figure.pin";
    if (edits) {
      EXPECT_EQ(accepted(request.dump()).if_revision, 7u) << method;
    } else {
      expect_error(request.dump(), "unknown_field", "/params/if_revision");
    }
  }
  expect_error(call("goal.remove", R"({"id":"g1","if_revision":-1})"), "out_of_range", "/params/if_revision");
  EXPECT_EQ(accepted(call("goal.remove", R"({"id":"g1"})")).if_revision, std::nullopt);
}

TEST(DecodeParams, EditsTakeAGestureAUuidAndForce) {
  const Request request =
      accepted(call("goal.set", R"({"gesture":"drag-1","once":"0b6f2f4e-7c1d-4a53-9a56-3f1e2d4c5b6a","force":true})"));
  EXPECT_EQ(request.gesture, "drag-1");
  EXPECT_EQ(request.once, "0b6f2f4e-7c1d-4a53-9a56-3f1e2d4c5b6a");
  EXPECT_TRUE(request.force);
  for (const char* method : {"goal.clear", "scene.new", "edit.undo", "edit.redo"})
    EXPECT_TRUE(accepted(call(method, R"({"force":true})")).force) << method;
  expect_error(call("goal.set", R"({"once":"again"})"), "invalid_params", "/params/once");
  expect_error(call("edit.undo", R"({"gesture":"drag-1"})"), "unknown_field", "/params/gesture");
  expect_error(call("goal.get", R"({"id":"g1","once":"0b6f2f4e-7c1d-4a53-9a56-3f1e2d4c5b6a"})"), "unknown_field",
               "/params/once");
}

TEST(DecodeParams, EditsAmongSeveralAreToldByTheirPlace) {
  const auto several = [](const char* edit) {
    return call("edit.apply", R"({"edits":[{"method":"goal.clear"},)" + std::string(edit) + "]}");
  };
  EXPECT_EQ(
      std::get<EditApply>(accepted(several(R"({"method":"goal.remove","params":{"id":"g1","if_revision":4}})")).params)
          .edits[1]
          .if_revision,
      4u);
  expect_error(several(R"({"method":"goal.sett","params":{}})"), "unknown_method", "/params/edits/1/method");
  expect_error(several(R"({"method":"edit.undo"})"), "invalid_params", "/params/edits/1/method");
  expect_error(several(R"({"method":"scene.open","params":{"name":"a"}})"), "invalid_params", "/params/edits/1/method");
  expect_error(several(R"({"params":{}})"), "missing_field", "/params/edits/1/method");
  expect_error(several(R"({"method":"goal.set","params":{"position":[0,0]}})"), "wrong_type",
               "/params/edits/1/params/position");
  expect_error(several(R"({"method":"goal.set","params":{"positon":[0,0,0]}})"), "unknown_field",
               "/params/edits/1/params/positon");
  expect_error(several(R"({"method":"goal.set","params":{"force":true}})"), "unknown_field",
               "/params/edits/1/params/force");
  expect_error(several(R"({"method":"goal.set","params":[]})"), "wrong_type", "/params/edits/1/params");
  expect_error(several(R"({"method":"goal.set","param":{}})"), "unknown_field", "/params/edits/1/param");
  expect_error(several("7"), "wrong_type", "/params/edits/1");
  std::string many = R"({"edits":[)";
  for (int i = 0; i < 1001; ++i) many += std::string(i ? "," : "") + R"({"method":"goal.clear"})";
  expect_error(call("edit.apply", many + "]}"), "too_large", "/params/edits");
}

TEST(DecodeParams, LeftOutNullAndValueAreThreeThings) {
  const GoalEdit left_out = params_of<GoalSet>("goal.set", "{}").edit;
  EXPECT_FALSE(left_out.weight.named());
  EXPECT_FALSE(left_out.user.named());
  const GoalEdit null = params_of<GoalSet>("goal.set", R"({"weight":null,"label":null,"user":null})").edit;
  EXPECT_TRUE(null.weight.is_reset());
  EXPECT_TRUE(null.label.is_reset());
  EXPECT_TRUE(null.user.is_reset());
  const GoalEdit value = params_of<GoalSet>("goal.set", R"({"weight":0,"label":"","user":[1,{"b":2,"a":1}]})").edit;
  EXPECT_EQ(*value.weight.value(), 0.0);
  EXPECT_EQ(*value.label.value(), "");
  EXPECT_EQ(*value.user.value(), R"([1,{"b":2,"a":1}])");
}

TEST(DecodeParams, UserDataIsShortAndShallow) {
  const auto user = [](const std::string& text) { return call("goal.set", "{\"user\":" + text + "}"); };
  expect_error(user("\"" + std::string(4095, 'x') + "\""), "out_of_range", "/params/user");
  accepted(user("\"" + std::string(4094, 'x') + "\""));
  accepted(user(std::string(16, '[') + std::string(16, ']')));
  expect_error(user(std::string(17, '[') + std::string(17, ']')), "out_of_range", "/params/user");
}

TEST(DecodeParams, EveryKindHasItsPayload) {
  const auto edit = [](const char* params) { return params_of<GoalSet>("goal.set", params).edit; };
  EXPECT_EQ(edit(R"({"kind":"aim"})").kind, GoalKind::aim);
  EXPECT_EQ(edit(R"({"orientation":{"quat_xyzw":[0,0,1,0]}})").orientation->rotation, quat_from_xyzw(0, 0, 1, 0));
  const GoalEdit aim = edit(R"({"aim":{"axis":[0,0,2],"direction":[1,0,0]}})");
  EXPECT_EQ(aim.aim->axis, Vec3(0, 0, 2));
  EXPECT_EQ(aim.aim->direction, Vec3(1, 0, 0));
  EXPECT_FALSE(aim.aim->point);
  EXPECT_EQ(edit(R"({"plane":{"point":[0,0,1],"normal":[0,0,1]}})").plane->side, PlaneTarget::Side::on);
  EXPECT_EQ(edit(R"({"plane":{"point":[0,0,1],"normal":[0,0,1],"side":"above"}})").plane->side,
            PlaneTarget::Side::above);
  EXPECT_EQ(edit(R"({"line":{"point":[0,0,1],"direction":[0,1,0]}})").line->direction, Vec3(0, 1, 0));
  const GoalEdit distance = edit(R"({"distance":{"to":"head/eyes","length":0.3,"compare":"at_least"}})");
  EXPECT_EQ(distance.distance->to.site, "eyes");
  EXPECT_EQ(distance.distance->compare, DistanceTarget::Compare::at_least);
  EXPECT_EQ(edit(R"({"balance":{"support":["left_foot","right_foot"],"margin":0.02}})").balance->support.size(), 2u);
  const auto joints = edit(R"({"posture":{"joints":{"a":1.5,"b":[0,0,0,1],"c":{"deviation":0.5}}}})").posture->joints;
  EXPECT_EQ(joints.at("a").share, std::vector<double>{1.5});
  EXPECT_EQ(joints.at("b").share.size(), 4u);
  EXPECT_EQ(joints.at("c").deviation, 0.5);
}

TEST(DecodeParams, PayloadsAreStrict) {
  const auto refuse = [](const char* params, const char* code, const char* path) {
    expect_error(call("goal.set", params), code, path);
  };
  refuse(R"({"kind":"look"})", "invalid_params", "/params/kind");
  refuse(R"({"orientation":[0,0,0,1]})", "wrong_type", "/params/orientation");
  refuse(R"({"orientation":{}})", "missing_field", "/params/orientation/quat_xyzw");
  refuse(R"({"orientation":{"quat_xyzw":[0,0,0,2]}})", "invalid_params", "/params/orientation/quat_xyzw");
  refuse(R"({"aim":{}})", "missing_field", "/params/aim/axis");
  refuse(R"({"aim":{"axis":[1,0,0],"at":[0,0,0]}})", "unknown_field", "/params/aim/at");
  refuse(R"({"plane":{"point":[0,0,0]}})", "missing_field", "/params/plane/normal");
  refuse(R"({"plane":{"point":[0,0,0],"normal":[0,0,1],"side":"below"}})", "invalid_params", "/params/plane/side");
  refuse(R"({"line":{"point":[0,0,0]}})", "missing_field", "/params/line/direction");
  refuse(R"({"distance":{"to":"head"}})", "missing_field", "/params/distance/length");
  refuse(R"({"distance":{"to":"","length":1}})", "unknown_segment", "/params/distance/to");
  refuse(R"({"balance":{"support":"left_foot"}})", "wrong_type", "/params/balance/support");
  refuse(R"({"posture":{"joints":{"waist":"up"}}})", "wrong_type", "/params/posture/joints/waist");
  refuse(R"({"posture":{"joints":{"waist":{"bend":1}}}})", "unknown_field", "/params/posture/joints/waist/bend");
  refuse(R"({"weight":{"position":1}})", "missing_field", "/params/weight/orientation");
  refuse(R"({"priority":1.5})", "wrong_type", "/params/priority");
  refuse(R"({"relative_to":"moon"})", "invalid_params", "/params/relative_to");
  refuse(R"({"relative_to":{}})", "missing_field", "/params/relative_to/segment");
  refuse(R"({"relative_to":{"sensor":"liberty:1","segment":"head"}})", "invalid_params", "/params/relative_to");
  refuse(R"({"relative_to":{"object":"chair","segment":"head"}})", "invalid_params", "/params/relative_to");
}

TEST(DecodeParams, APinNamesWhatItHolds) {
  EXPECT_EQ(params_of<FigurePin>("figure.pin", R"({"segment":"left_foot","hold":"pose"})").hold, Pin::Hold::pose);
  EXPECT_FALSE(params_of<FigurePin>("figure.pin", R"({"segment":"left_foot","hold":null})").hold);
  expect_error(call("figure.pin", R"({"segment":"left_foot"})"), "missing_field", "/params/hold");
  expect_error(call("figure.pin", R"({"segment":"left_foot","hold":"all"})"), "invalid_params", "/params/hold");
}

TEST(DecodeParams, SwingAndTwist) {
  const auto figure = [](const char* joint) {
    return call("figure.set",
                std::string(R"({"id":"a","document":{"format":"posed.figure/1","root":"a","segments":[{"name":"a",
      "touch_point":[0,0,0],"joint":{"name":"j","type":"ball","position":[0,0,0],)") +
                    joint + "}}]}}");
  };
  const auto joint = [&](const char* text) {
    return std::get<FigureSet>(accepted(figure(text)).params).document->segments[0].joint;
  };
  const Joint ellipse = joint(R"("swing":{"ellipse":[0.8,0.5],"center":[0,0,1]},"twist":[-1,0.5])");
  EXPECT_EQ(ellipse.swing->kind, Swing::Kind::ellipse);
  EXPECT_EQ(ellipse.swing->radii[1], 0.5);
  EXPECT_EQ(ellipse.swing->center, kZ);
  EXPECT_EQ(ellipse.twist->min, -1.0);
  const Joint polygon = joint(R"("swing":{"polygon":[[1,0,0],[0,1,0],[0,0,1]]})");
  EXPECT_EQ(polygon.swing->kind, Swing::Kind::polygon);
  EXPECT_EQ(polygon.swing->corners[1], kY);
  const std::string path = "/params/document/segments/0/joint/";
  expect_error(figure(R"("swing":{})"), "invalid_params", path + "swing");
  expect_error(figure(R"("swing":{"ellipse":[1,1],"polygon":[]})"), "invalid_params", path + "swing");
  expect_error(figure(R"("swing":{"ellipse":[1]})"), "wrong_type", path + "swing/ellipse");
  expect_error(figure(R"("swing":{"polygon":[[1,0,0]],"center":[0,0,1]})"), "unknown_field", path + "swing/center");
  expect_error(figure(R"("twist":1)"), "wrong_type", path + "twist");
}

TEST(DecodeParams, APlaceIsASegmentAPointOrASite) {
  const auto at = [](const char* text) {
    return *params_of<GoalSet>("goal.set", std::string("{\"at\":") + text + "}").edit.at;
  };
  EXPECT_EQ(at("\"right_hand\""), (Attachment{"right_hand", {}, ""}));
  EXPECT_EQ(at("\"right_hand/fingertip\""), (Attachment{"right_hand", {}, "fingertip"}));
  EXPECT_EQ(at("\"/fingertip\""), (Attachment{"", {}, "fingertip"}));
  EXPECT_EQ(at(R"({"segment":"head","point":[0,0.1,0]})"), (Attachment{"head", Vec3(0, 0.1, 0), ""}));
}

TEST(DecodeParams, QuaternionsAreOfUnitLength) {
  const auto figure = [](const char* quat) {
    return call("figure.set",
                std::string(R"({"id":"a","document":{"format":"posed.figure/1","root":"a","segments":[{"name":"a",
      "touch_point":[0,0,0],"joint":{"name":"j","type":"ball","position":[0,0,0],"quat_xyzw":)") +
                    quat + "}}]}}");
  };
  expect_error(figure("[0,0,0,1.1]"), "invalid_params", "/params/document/segments/0/joint/quat_xyzw");
  expect_error(figure("[0,0,0,0]"), "invalid_params", "/params/document/segments/0/joint/quat_xyzw");
  // Rounded ones are made exact.
  const Request rounded = accepted(figure("[0,0,0.7071,0.7071]"));
  const Quat q = std::get<FigureSet>(rounded.params).document->segments[0].joint.parent_from_joint.rotation;
  EXPECT_NEAR(glm::length(q), 1.0, 1e-15);
  EXPECT_NEAR(q.z, std::sqrt(0.5), 1e-15);
}

}  // namespace
}  // namespace posed::proto
