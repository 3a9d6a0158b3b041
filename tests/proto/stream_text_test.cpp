// Stream frames are written by hand: they must be JSON all the same, and as exact as the protocol says.
#include <random>

#include "tests/proto/proto_fixture.h"

namespace posed::proto {
namespace {

constexpr double kMetre = 5e-7, kQuat = 5e-8;

FigurePose random_pose(std::mt19937& random, int segments) {
  std::normal_distribution<double> normal;
  const auto vec3 = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  FigurePose pose;
  pose.figure = "body";
  for (int i = 0; i < segments; ++i) {
    const Quat q = glm::normalize(Quat(normal(random), normal(random), normal(random), normal(random)));
    pose.world_from_segment.push_back({vec3(), q});
    for (const double v : xyzw(q)) pose.q.push_back(v);
  }
  GoalFrame goal{"g1",
                 vec3(),
                 vec3(),
                 0.25,
                 vec3(),
                 GoalState::unreachable,
                 {{"g2", 0.0}, {"", 0.125}, {"", 0.0, "right_elbow", Cause::Side::swing}}};
  pose.goals = {goal};
  pose.cost = 0.1;
  pose.status = SolveStatus::stalled;
  pose.branch_changed = true;
  return pose;
}

json data_of(const std::string& line) {
  EXPECT_TRUE(json::accept(line)) << line;
  const json frame = json::parse(line, nullptr, false);
  EXPECT_EQ(frame["jsonrpc"], "2.0");
  EXPECT_EQ(frame["method"], "stream.frame");
  EXPECT_EQ(line.find('\n'), std::string::npos);
  return frame["params"]["data"];
}

// The first coordinate of a goal that is touched there, as text.
std::string metres(double value) {
  PoseData data;
  FigurePose pose;
  pose.figure = "f";
  pose.world_from_segment.push_back({{value, 0, 0}, quat_identity()});
  data.figures = {pose};
  const std::string line = encode_pose_frame(1, data, {true, false, false});
  EXPECT_TRUE(json::accept(line)) << line;
  const std::size_t begin = line.find("[[") + 2;
  return line.substr(begin, line.find(',', begin) - begin);
}

TEST(StreamText, PosesAreExactToTheLastDecimal) {
  std::mt19937 random{6};
  for (int i = 0; i < 50; ++i) {
    const FigurePose pose = random_pose(random, 18);
    const json figure = data_of(encode_pose_frame(812, {82, 16, {pose}}, {}))["figures"][0];
    for (std::size_t s = 0; s < 18; ++s) {
      const Transform& t = pose.world_from_segment[s];
      const auto q = xyzw(t.rotation);
      ASSERT_EQ(figure["world_from_segment"][s].size(), 7u);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(figure["world_from_segment"][s][k], t.position[k], kMetre * 1.0001);
      for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(figure["world_from_segment"][s][3 + k], q[k], kQuat * 1.0001);
    }
    for (std::size_t k = 0; k < pose.q.size(); ++k) EXPECT_NEAR(figure["q"][k], pose.q[k], kQuat * 1.0001);
  }
}

TEST(StreamText, APoseFrameSaysAllThatAReaderNeeds) {
  std::mt19937 random{7};
  const FigurePose pose = random_pose(random, 2);
  const std::string line = encode_pose_frame(812, {82'000'000'001, 16, {pose}}, {});
  const json frame = json::parse(line);
  EXPECT_EQ(frame["params"]["stream"], "pose");
  EXPECT_EQ(frame["params"]["seq"], 812);
  const json& data = frame["params"]["data"];
  EXPECT_EQ(data["t_ns"], 82'000'000'001);
  EXPECT_EQ(data["revision"], 16);
  const json& figure = data["figures"][0];
  EXPECT_EQ(figure["figure"], "body");
  EXPECT_EQ(figure["cost"], 0.1);
  EXPECT_EQ(figure["status"], "stalled");
  EXPECT_EQ(figure["branch_changed"], true);
  const json& goal = figure["goals"][0];
  EXPECT_EQ(goal["id"], "g1");
  EXPECT_EQ(goal["error"], 0.25);
  EXPECT_EQ(goal["state"], "unreachable");
  EXPECT_EQ(goal["causes"],
            json::parse(R"([{"goal":"g2"},{"beyond_m":0.125},{"limit":"right_elbow","side":"swing"}])"));
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(goal["touch"][k], pose.goals[0].touch[k], kMetre * 1.0001);
    EXPECT_NEAR(goal["target"][k], pose.goals[0].target[k], kMetre * 1.0001);
    EXPECT_NEAR(goal["force"][k], pose.goals[0].force[k], kMetre * 1.0001);
  }
  EXPECT_EQ(data_of(encode_pose_frame(1, {}, {}))["figures"], json::array());
}

TEST(StreamText, ObjectsAreSentWhereSensorsLeadAny) {
  const PoseData data{1, 2, {}, {{"box", {{0.1234567, 0, -1}, quat_about(kZ, 1.0)}}, {"rod", {}}}};
  const json objects = data_of(encode_pose_frame(1, data, {}))["objects"];
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0]["object"], "box");
  EXPECT_NEAR(objects[0]["world_from_object"][0], 0.1234567, kMetre * 1.0001);
  EXPECT_NEAR(objects[0]["world_from_object"][5], std::sin(0.5), kQuat * 1.0001);
  EXPECT_EQ(objects[1], json::parse(R"({"object":"rod","world_from_object":[0,0,0,0,0,0,1]})"));
  EXPECT_FALSE(data_of(encode_pose_frame(1, data, {true, true, true, false})).contains("objects"));
  EXPECT_FALSE(data_of(encode_pose_frame(1, {}, {})).contains("objects"));
}

TEST(StreamText, OnlyTheWantedFieldsAreSent) {
  std::mt19937 random{8};
  const PoseData data{1, 2, {random_pose(random, 2)}};
  for (const bool world : {false, true}) {
    for (const bool q : {false, true}) {
      for (const bool goals : {false, true}) {
        const json figure = data_of(encode_pose_frame(1, data, {world, q, goals}))["figures"][0];
        EXPECT_EQ(figure.contains("world_from_segment"), world);
        EXPECT_EQ(figure.contains("q"), q);
        EXPECT_EQ(figure.contains("goals"), goals);
        EXPECT_TRUE(figure.contains("cost"));
      }
    }
  }
}

TEST(StreamText, NumbersAreShortAndNeverMinusZero) {
  EXPECT_EQ(metres(0.0), "0");
  EXPECT_EQ(metres(-0.0), "0");
  EXPECT_EQ(metres(-4e-7), "0");
  EXPECT_EQ(metres(1e-300), "0");
  EXPECT_EQ(metres(5e-324), "0");
  EXPECT_EQ(metres(1.5), "1.5");
  EXPECT_EQ(metres(-0.000001), "-0.000001");
  EXPECT_EQ(metres(0.0000006), "0.000001");
  EXPECT_EQ(metres(0.9999996), "1");
  EXPECT_EQ(metres(-2.0000001), "-2");
  EXPECT_EQ(metres(123456.789), "123456.789");
  EXPECT_EQ(metres(-1e6), "-1000000");
  EXPECT_EQ(metres(100), "100");
  EXPECT_EQ(metres(10.01), "10.01");
}

TEST(StreamText, HugeNumbersStayNumbers) {
  for (const double value : {9e8, 9e9, -9e9, 1e15, 1.7976931348623157e308, -1e300}) {
    const double back = json::parse(metres(value));
    EXPECT_NEAR(back / value, 1.0, 1e-15) << metres(value);
  }
}

TEST(StreamText, TrackerFrames) {
  SensorData sensor;
  sensor.sensor = "liberty:2";
  sensor.position = {0.4123456, -0.2987654, 1.2};
  sensor.rotation = quat_about(kX, -1.0);
  sensor.buttons = 3;
  sensor.flags = {"distorted", "error_x"};
  sensor.device_count = 4294967295u;
  sensor.device_t_ns = -21;
  const json data = data_of(encode_tracker_frame(18446744073709551615u, {5, 3, "liberty", {sensor, SensorData{}}}));
  EXPECT_EQ(data["t_ns"], 5);
  EXPECT_EQ(data["sample_t_ns"], 3);
  EXPECT_EQ(data["device"], "liberty");
  ASSERT_EQ(data["sensors"].size(), 2u);
  const json& s = data["sensors"][0];
  EXPECT_EQ(s["sensor"], "liberty:2");
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(s["position"][k], sensor.position[k], kMetre * 1.0001);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(s["quat_xyzw"][k], xyzw(sensor.rotation)[k], kQuat * 1.0001);
  EXPECT_EQ(s["buttons"], 3);
  EXPECT_EQ(s["flags"], json::parse(R"(["distorted","error_x"])"));
  EXPECT_EQ(s["device_count"], 4294967295u);
  EXPECT_EQ(s["device_t_ns"], -21);
  EXPECT_EQ(data_of(encode_tracker_frame(1, {5, 0, "liberty", {}}))["sensors"], json::array());
}

TEST(StreamText, CamerasAreInTheWorldToTheirDecimals) {
  const CameraData cameras{7, {{"main", {{0.1234567, 0, -1}, quat_about(kZ, 1.0)}, 0.9}, {"b", {}, kDefaultFovY}}};
  const json data = data_of(encode_camera_frame(3, cameras));
  EXPECT_EQ(data["t_ns"], 7);
  ASSERT_EQ(data["cameras"].size(), 2u);
  EXPECT_EQ(data["cameras"][0]["camera"], "main");
  EXPECT_NEAR(data["cameras"][0]["position"][0], 0.1234567, kMetre * 1.0001);
  EXPECT_NEAR(data["cameras"][0]["quat_xyzw"][2], std::sin(0.5), kQuat * 1.0001);
  EXPECT_NEAR(data["cameras"][1]["fov_y"], kDefaultFovY, kQuat * 1.0001);
  EXPECT_EQ(data_of(encode_camera_frame(3, {7, {}}))["cameras"], json::array());
}

// A device may put any byte where its error letter stands: it broke the line for every viewer.
TEST(StreamText, AnErrorLetterOfAnyByteLeavesTheLineWhole) {
  for (int byte = 0; byte < 256; ++byte) {
    SensorData sensor;
    sensor.sensor = "liberty:1";
    sensor.flags = {std::string("error_") + static_cast<char>(byte)};
    const std::string line = encode_tracker_frame(1, {5, 0, "liberty", {sensor}});
    ASSERT_TRUE(json::accept(line)) << byte;
    EXPECT_EQ(line.find('\n'), std::string::npos) << byte;
    EXPECT_EQ(json::parse(line)["params"]["data"]["sensors"][0]["flags"].size(), 1u) << byte;
  }
}

TEST(StreamText, StatsSceneAndLost) {
  const json stats = data_of(encode_stats_frame(83, {1, 2, 3, 84.2, 1e-9, 4, 5}));
  EXPECT_EQ(stats, json::parse(R"({"t_ns":1,"frames":2,"solves":3,"solve_us":84.2,"sample_to_send_us":1e-9,
                                   "connections":4,"dropped":5,"frame_age_us":0,"frame_age_p99_us":0,"acked_age_us":0,"acked_age_p99_us":0})"));
  const std::string document = encode_scene({});
  EXPECT_EQ(data_of(encode_scene_snapshot(1, 21, document)),
            (json{{"revision", 21}, {"document", json::parse(document)}}));
  EXPECT_EQ(data_of(encode_scene_patch(2, 21, 23, "s3", "[]")),
            json::parse(R"({"from_revision":21,"revision":23,"by":"s3","patch":[]})"));
  EXPECT_EQ(json::parse(encode_lost(Stream::tracker, 14)),
            json::parse(R"({"jsonrpc":"2.0","method":"stream.lost","params":{"stream":"tracker","dropped":14}})"));
}

TEST(StreamText, AClientReadsThemAll) {
  std::mt19937 random{9};
  const PoseData sent{82, 16, {random_pose(random, 3)}};
  const Result<Incoming> in = decode_incoming(encode_pose_frame(812, sent, {}));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->method, "stream.frame");
  EXPECT_EQ(in->stream, Stream::pose);
  EXPECT_EQ(in->seq, 812u);
  EXPECT_FALSE(in->id);
  const Result<PoseData> pose = decode_message<PoseData>(in->data);
  ASSERT_TRUE(pose) << pose.error().message << pose.error().path;
  // What was rounded once stays as it is.
  EXPECT_EQ(encode_pose_frame(812, *pose, {}), encode_pose_frame(812, *decode_message<PoseData>(in->data), {}));
  EXPECT_EQ(pose->figures[0].goals[0].causes[1].beyond_m, 0.125);
  EXPECT_EQ(pose->figures[0].goals[0].causes[2].limit, "right_elbow");
  EXPECT_EQ(pose->figures[0].goals[0].causes[2].side, Cause::Side::swing);
  const Result<Incoming> lost = decode_incoming(encode_lost(Stream::stats, 14));
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->method, "stream.lost");
  EXPECT_EQ(lost->dropped, 14u);
}

}  // namespace
}  // namespace posed::proto
