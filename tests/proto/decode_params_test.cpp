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
  EXPECT_EQ(bad.error.hint, "one of: pose tracker scene stats");
  expect_error(call("binding.set", R"({"mode":"both"})"), "invalid_params", "/params/mode");
  expect_error(call("binding.set", R"({"axes":["x","w"]})"), "invalid_params", "/params/axes");
  expect_error(call("pose.reset", R"({"to":"sitting"})"), "invalid_params", "/params/to");
}

TEST(DecodeParams, WhatIsReservedIsNotAvailable) {
  const std::pair<const char*, const char*> fields[] = {{"gesture", "\"drag-1\""},
                                                        {"once", "\"0b6f\""},
                                                        {"kind", "\"aim\""},
                                                        {"orientation", "{}"},
                                                        {"aim", "{}"},
                                                        {"plane", "{}"},
                                                        {"line", "{}"},
                                                        {"distance", "{}"},
                                                        {"balance", "{}"},
                                                        {"posture", "{}"},
                                                        {"priority", "1"},
                                                        {"relative_to", R"({"object":"chair"})"},
                                                        {"scene", "\"other\""}};
  for (const auto& [field, value] : fields) {
    expect_error(call("goal.set", std::string("{\"") + field + "\":" + value + "}"), "not_available",
                 std::string("/params/") + field);
  }
  expect_error(call("binding.set", R"({"to":{"joint":"waist"}})"), "not_available", "/params/to/joint");
  expect_error(call("binding.set", R"({"axes":["x","rx"]})"), "not_available", "/params/axes");
  expect_error(call("binding.set", R"({"clutch":{"button":0}})"), "not_available", "/params/clutch");
  expect_error(call("binding.set", R"({"filter":{}})"), "not_available", "/params/filter");
  expect_error(call("joint.set", R"({"joint":"waist","hold":true})"), "not_available", "/params/hold");
  expect_error(call("session.hello", R"({"token":"x"})"), "not_available", "/params/token");
  expect_error(call("session.hello", R"({"protocol":2})"), "not_available", "/params/protocol");
  expect_error(call("stream.subscribe", R"({"stream":"pose","encoding":"cbor"})"), "not_available", "/params/encoding");
}

TEST(DecodeParams, WhatIsReservedMayBeSaidAsItIs) {
  params_of<GoalSet>("goal.set", R"({"kind":"position","relative_to":"world","priority":0,"aim":null,"scene":"main"})");
  params_of<StreamSubscribe>("stream.subscribe", R"({"stream":"pose","encoding":"json"})");
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
                           : method.ends_with(".remove") || method == "pose.reset" || method == "pose.mirror";
    if (edits) {
      EXPECT_EQ(accepted(request.dump()).if_revision, 7u) << method;
    } else {
      expect_error(request.dump(), "unknown_field", "/params/if_revision");
    }
  }
  expect_error(call("goal.remove", R"({"id":"g1","if_revision":-1})"), "out_of_range", "/params/if_revision");
  EXPECT_EQ(accepted(call("goal.remove", R"({"id":"g1"})")).if_revision, std::nullopt);
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
