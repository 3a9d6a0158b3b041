// The client's requests and the daemon's reading of them, through one description.
#include "server/solver/tempus.h"
#include "tests/proto/proto_fixture.h"

namespace posed::proto {
namespace {

// A message of every method that has fields, with each field said.
std::vector<Params> full_messages() {
  GoalEdit goal;
  goal.id = "g1";
  goal.figure = "body";
  goal.at = Attachment{"right_hand", Vec3(0.1, 1.0 / 3.0, -1e-9), ""};
  goal.position = Vec3(0.5, -0.3, 1e6);
  goal.weight = 0.1;
  goal.tolerance = Patched<GoalTolerance>::reset();
  goal.enabled = false;
  goal.label = std::string("\xc3\xa9\"\\\n");
  goal.user = std::string(R"({"b":[1,2.5,null],"a":{}})");
  GoalEdit pose;
  pose.kind = GoalKind::pose;
  pose.orientation = OrientationTarget{quat_from_xyzw(0.5, 0.5, 0.5, 0.5)};
  pose.relative_to = GoalBase{GoalBase::Kind::segment, "body", "head", ""};
  GoalWeight both = 4.0;
  both.orientation = 0.5;
  pose.weight = both;
  pose.priority = -3;
  pose.tolerance = GoalTolerance(Vec3(0.01, 0.0, 0.2));
  BindingEdit binding;
  binding.id = "b1";
  binding.sensor = "liberty:2";
  binding.to = BindingTarget{"g1", "", "", "", ""};
  binding.axes = Axes{true, false, true, false, true};
  binding.clutch = Clutch{3};
  binding.buttons = std::vector<ButtonAction>{{0, ButtonAction::Do::recenter}, {1, ButtonAction::Do::save}};
  binding.offset = SensorOffset{{0.01, 0, -0.02}, quat_from_xyzw(0.5, 0.5, 0.5, 0.5)};
  binding.filter = BindingFilter{OneEuro{0.5, 3.0, 2.0}, 12.5};
  binding.mode = Binding::Mode::relative;
  binding.scale = -2.5;
  binding.label = Patched<std::string>::reset();
  binding.user = std::string("7");
  ObjectEdit object;
  object.id = "chair";
  object.position = Vec3(0.1, 1.0 / 3.0, -1e-9);
  object.rotation = quat_from_xyzw(0.5, 0.5, 0.5, 0.5);
  object.shapes = std::vector<Shape>{{Shape::Kind::box, {0, 0, 0.2}, {0.2, 0.2, 0.02}, 0.0}};
  object.label = std::string("blue");
  object.user = std::string("[1]");
  CameraEdit camera;
  camera.id = "main";
  camera.position = Vec3(0.1, 0, 0.05);
  camera.rotation = Patched<Quat>::reset();
  camera.relative_to = GoalBase{GoalBase::Kind::segment, "body", "head", ""};
  camera.fov_y = 0.9;
  camera.label = std::string("eyes");
  camera.user = std::string("{}");
  TrackerConfigure configure{"liberty", true, std::string("monday"), 120.0, std::vector<std::string>{"liberty:1"}, {},
                             {},        {}};
  configure.hemisphere["liberty:1"] = Vec3(0, 0, 1);
  configure.position_filter = DeviceFilter{true, 0.2, 0.3, 0.8, 0.95};
  configure.attitude_filter = Patched<DeviceFilter>::reset();
  FigureSet figure{"body", Patched<std::string>::reset(), 1.8, *tempus(1.8), std::string("Ana"), std::string("[]")};
  SolverSet solver{std::string("reach_tree"), 400, Patched<int>::reset()};
  Solve solve;
  solve.figure = FigureChoice{"", "tempus", 1.6, {}};
  solve.goals = {{goal}, {pose}};
  solve.pins.emplace()["left_foot"] = Pin{Pin::Hold::position, Vec3(0, 0.1, 0), {}};
  solve.start = Start{Start::Kind::q, {1.0 / 3.0, 2, 3}};
  solve.deadline_us = 500;
  solve.method = "reach_tree";
  solve.fields = {"q"};
  SolveBatch batch;
  batch.figure = FigureChoice{"", "", 1.75, *tempus(1.8)};
  batch.start = Start{Start::Kind::current, {}};
  batch.problems = {{solve, {}, ""}, {{}, Error{"missing_field", "", "", ""}, R"({"goal":[]})"}};
  batch.progress = true;
  EditApply several;
  several.edits.push_back({7, GoalSet{goal}});
  several.edits.push_back({{}, GoalClear{"body"}});
  several.label = "tidy up";
  return {SessionHello{1, {"posectl", "0.1.0"}, "ana", "", "8c1f"},
          GoalGrab{"g1", true},
          GoalRelease{"g1", true},
          several,
          EditUndo{12},
          EditHistory{7},
          figure,
          FigureGet{"body"},
          FigureRemove{"body"},
          FigurePin{"body", "left_foot", Pin::Hold::pose},
          GoalSet{goal},
          GoalSet{pose},
          GoalGet{"g1"},
          GoalRemove{"g1"},
          GoalClear{"body"},
          ObjectSet{object},
          ObjectGet{"chair"},
          ObjectRemove{"chair"},
          BindingSet{binding},
          BindingGet{"b1"},
          BindingRemove{"b1"},
          JointSet{"body", "waist", {0, 0.0998334, 0, 0.9950042}, 0.5, 1.2, -0.1, JointHold{2.5}},
          CameraSet{camera},
          CameraGet{"main"},
          CameraRemove{"main"},
          TrackerGrab{"liberty", true},
          TrackerRelease{"liberty", true},
          configure,
          TrackerReset{"liberty", true},
          TrackerTouch{"liberty:1", true, 250, Vec3(1, 2, 3)},
          TrackerAlign{"liberty", "monday", true, {{{1, 2, 3}, {0, 1.0 / 3.0, 0}}}},
          TrackerTip{"liberty:1", "monday", true, 2000, Vec3(0.1, 0, 0)},
          TrackerBoresight{"liberty:1", "monday", true, 100, quat_from_xyzw(0.5, 0.5, 0.5, 0.5)},
          TrackerForget{"liberty", "monday", true},
          JointGet{"body", "waist"},
          PoseGet{"body", 42, 100},
          PoseSet{"body", {1.0 / 3.0, 2, 3}},
          PoseReset{"body", "start"},
          PoseMirror{"body"},
          solver,
          solve,
          batch,
          SceneNew{"empty"},
          SceneSave{"monday"},
          SceneOpen{"monday"},
          StreamSubscribe{Stream::pose, {"body"}, {"q", "goals"}, 59.94, 3},
          StreamUnsubscribe{Stream::stats},
          StreamAck{Stream::scene, 18446744073709551615u}};
}

void expect_round_trip(const Params& message) {
  const std::string text = encode_request(7, message);
  const Request request = accepted(text);
  EXPECT_EQ(request.id, "7");
  EXPECT_EQ(request.params.index(), message.index()) << text;
  EXPECT_EQ(encode_request(7, request.params), text);
  const Request notification = accepted(encode_notification(message));
  EXPECT_EQ(notification.id, "");
  EXPECT_EQ(encode_request(7, notification.params), text);
}

TEST(Requests, EveryMethodComesThrough) {
  const std::vector<Params> messages = every_message();
  ASSERT_EQ(messages.size(), 61u);
  for (const Params& message : messages) expect_round_trip(message);
}

TEST(Requests, EveryFieldComesThrough) {
  for (const Params& message : full_messages()) {
    SCOPED_TRACE(method_of(message).name);
    expect_round_trip(message);
    // The text says more than that of an empty message: nothing is lost on the way out either.
    const json full = json::parse(encode_request(7, message))["params"];
    json fewer = json::parse(encode_request(7, every_message()[message.index()]))["params"];
    EXPECT_NE(full, fewer);
    for (const auto& [key, value] : fewer.items()) EXPECT_TRUE(full.contains(key)) << key;
  }
}

TEST(Requests, EveryMethodIsFoundByItsName) {
  for (const Params& message : every_message()) {
    const Method& method = method_of(message);
    ASSERT_EQ(find_method(method.name), &method);
    EXPECT_EQ(method.index, message.index());
    EXPECT_FALSE(reserved_method(method.name)) << method.name;
  }
}

TEST(Requests, OfAGoalSayWhatTheyChangeAndNoMore) {
  GoalEdit edit;
  edit.id = "g1";
  edit.position = Vec3(0.5, -0.3, 1.25);
  edit.weight = Patched<GoalWeight>::reset();
  EXPECT_EQ(
      encode_request(3, GoalSet{edit}),
      R"({"jsonrpc":"2.0","id":3,"method":"goal.set","params":{"id":"g1","position":[0.5,-0.3,1.25],"weight":null}})");
}

TEST(Requests, CallTakesAnyMethodAndParametersThatAreAnObject) {
  EXPECT_EQ(*encode_call(1, "goal.get", R"({ "id" : "g1" })"),
            R"({"jsonrpc":"2.0","id":1,"method":"goal.get","params":{"id":"g1"}})");
  EXPECT_EQ(encode_call(1, "goal.get", "{").error().code, "parse_error");
  EXPECT_EQ(encode_call(1, "goal.get", "[]").error().code, "wrong_type");
}

// A method's name typed in another encoding made the codec throw.
TEST(Requests, CallQuotesAMethodOfAnyBytes) {
  const Result<std::string> text = encode_call(1, "a\"\\\xff", "{}");
  ASSERT_TRUE(text);
  EXPECT_TRUE(json::accept(*text));
  EXPECT_EQ(refused(*text).error.code, "unknown_method");
}

TEST(Requests, EncodingLeavesTheMessageAlone) {
  BindingEdit edit;
  edit.to = BindingTarget{"a goal whose name is a string of its own on the heap", "", "", "", ""};
  const Params message = BindingSet{edit};
  const std::string* before = &std::get<BindingSet>(message).edit.to->goal;
  const char* text = before->data();
  (void)encode_request(1, message);
  EXPECT_EQ(*before, edit.to->goal);
  EXPECT_EQ(before->data(), text);
}

}  // namespace
}  // namespace posed::proto
