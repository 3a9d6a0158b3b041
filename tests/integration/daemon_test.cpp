// Requests, poses and streams of a whole daemon over real sockets.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <regex>

#include "running_daemon.h"

namespace posed {
namespace {

using test::RunningDaemon;
constexpr auto kPatience = std::chrono::seconds(60);

proto::PoseResult pose_at(client::Client& client, std::uint64_t revision) {
  proto::PoseGet get;
  get.min_revision = revision;
  get.wait_ms = 10'000;
  const auto pose = client.call<proto::PoseResult>(get);
  EXPECT_TRUE(pose) << pose.error().message;
  return pose ? *pose : proto::PoseResult{};
}

const proto::GoalFrame* find_goal(const std::vector<proto::GoalFrame>& goals, const std::string& id) {
  for (const auto& goal : goals) {
    if (goal.id == id) return &goal;
  }
  return nullptr;
}

proto::GoalSet hand_goal(const Vec3& position) {
  proto::GoalSet set;
  set.edit.at = Attachment{"right_hand", {}, ""};
  set.edit.position = position;
  return set;
}

TEST(Daemon, TheNcLineSentTwiceLeavesOneGoal) {
  if (std::system("command -v nc >/dev/null && nc -h 2>&1 | grep -q -- '-N'") != 0)
    GTEST_SKIP() << "SKIPPED: nc (netcat-openbsd) is not installed";
  const RunningDaemon daemon({}, "empty");
  const std::string line =
      R"(printf '%s\n' '{"jsonrpc":"2.0","id":1,"method":"goal.set","params":{"at":"right_hand","position":[0.5,-0.3,1.2]}}' | nc -N 127.0.0.1 )" +
      std::to_string(daemon.port());
  int before = 0;
  for (int i = 0; i < 2; ++i) {
    FILE* pipe = popen(line.c_str(), "r");
    char text[512] = {};
    const std::size_t size = fread(text, 1, sizeof text - 1, pipe);
    EXPECT_EQ(pclose(pipe), 0);
    const std::string reply(text, size);
    EXPECT_NE(reply.find(R"("result":{"id":"body.right_hand.position")"), std::string::npos) << reply;
    const std::size_t at = reply.find("\"entity_revision\":");
    ASSERT_NE(at, std::string::npos) << reply;
    const int revision = std::atoi(reply.c_str() + at + 18);
    EXPECT_TRUE(i == 0 ? revision > 0 : revision == before + 1) << reply;
    before = revision;
  }
  auto client = daemon.connect();
  const auto list = client.call<proto::GoalListResult>(proto::GoalList{});
  ASSERT_TRUE(list);
  EXPECT_EQ(list->goals.size(), 1u);
}

TEST(Daemon, AnEditIsAnsweredSolvedAndStreamed) {
  const RunningDaemon daemon;
  auto editor = daemon.connect(), viewer = daemon.connect();
  ASSERT_TRUE(viewer.subscribe({proto::Stream::pose, {}, {}, 0.0, 3}));
  const auto edited = editor.call<proto::EditResult>(hand_goal({0.35, -0.25, 1.2}));
  ASSERT_TRUE(edited) << edited.error().message;
  for (;;) {
    const auto frame = viewer.next(kPatience);
    ASSERT_TRUE(frame) << frame.error().message;
    const auto data = proto::decode_message<proto::PoseData>(frame->data);
    ASSERT_TRUE(data) << data.error().message;
    if (data->revision < edited->revision) continue;
    ASSERT_EQ(data->figures.size(), 1u);
    EXPECT_EQ(data->figures[0].world_from_segment.size(), 18u);
    const auto* goal = find_goal(data->figures[0].goals, edited->id);
    ASSERT_NE(goal, nullptr);
    EXPECT_EQ(goal->state, GoalState::reached);
    EXPECT_LT(glm::length(goal->touch - Vec3(0.35, -0.25, 1.2)), 1e-3);
    break;
  }
}

TEST(Daemon, StreamedPosesKeepBoneLengthsToTheirPrintedDigits) {
  const RunningDaemon daemon({"simulated:3"});
  auto client = daemon.connect();
  const auto figure = client.call<proto::FigureResult>(proto::FigureGet{"body"});
  ASSERT_TRUE(figure);
  std::map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < figure->document.segments.size(); ++i) index[figure->document.segments[i].name] = i;
  ASSERT_TRUE(client.call<proto::EditResult>(hand_goal({0.4, -0.3, 1.2})));
  ASSERT_TRUE(client.call("binding.set", R"({"sensor":"simulated:1","to":{"goal":"body.right_hand.position"}})"));
  ASSERT_TRUE(client.subscribe({proto::Stream::pose, {}, {"world_from_segment"}, 0.0, 0}));
  for (int n = 0; n < 50; ++n) {
    const auto frame = client.next(kPatience);
    ASSERT_TRUE(frame) << frame.error().message;
    const auto data = proto::decode_message<proto::PoseData>(frame->data);
    ASSERT_TRUE(data);
    const auto& world = data->figures[0].world_from_segment;
    for (std::size_t i = 0; i < world.size(); ++i) {
      const Segment& segment = figure->document.segments[i];
      if (segment.parent.empty()) continue;
      const Vec3 joint = world[index[segment.parent]] * segment.joint.parent_from_joint.position;
      // Half a micrometre on each coordinate of both ends, and seven digits of the parent's quaternion.
      EXPECT_LT(glm::length(joint - world[i].position), 2.1e-6) << segment.name;
    }
  }
}

TEST(Daemon, ASensorBoundToAGoalMovesTheFigureWithNoClientBetween) {
  const RunningDaemon daemon({"simulated:7"});
  auto client = daemon.connect();
  const auto edited = client.call<proto::EditResult>(hand_goal({0.4, -0.3, 1.2}));
  ASSERT_TRUE(edited);
  proto::BindingSet bind;
  bind.edit.sensor = "simulated:1";
  bind.edit.to = BindingTarget{edited->id, "", "", "", ""};
  const auto bound = client.call<proto::EditResult>(bind);
  ASSERT_TRUE(bound) << bound.error().message;
  const auto revision = client.call<proto::StatusResult>(proto::SessionStatus{})->revision;
  ASSERT_TRUE(client.subscribe({proto::Stream::pose, {}, {"goals"}, 0.0, 0}));
  double way = 0.0;
  std::optional<Vec3> last;
  for (int moved = 0; moved < 100;) {
    const auto frame = client.next(kPatience);
    ASSERT_TRUE(frame) << frame.error().message;
    const auto data = proto::decode_message<proto::PoseData>(frame->data);
    ASSERT_TRUE(data);
    EXPECT_EQ(data->revision, revision) << "live motion is no edit";
    EXPECT_TRUE(data->figures[0].world_from_segment.empty()) << "the field was not asked for";
    const auto* goal = find_goal(data->figures[0].goals, edited->id);
    ASSERT_NE(goal, nullptr);
    if (last && *last != goal->touch) ++moved, way += glm::length(*last - goal->touch);
    last = goal->touch;
  }
  EXPECT_GT(way, 0.01);
}

TEST(Daemon, WhatIsReservedIsRefusedNotAliased) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  const auto reply = client.call("take.record", "{}");
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, "not_available") << reply.error().message;
}

TEST(Daemon, TheAgeOfFramesIsInTheStatistics) {
  const RunningDaemon daemon({"simulated:5"});
  auto client = daemon.connect();
  ASSERT_TRUE(client.subscribe({proto::Stream::tracker, {}, {}, 0.0, 3}));
  ASSERT_TRUE(client.subscribe({proto::Stream::stats, {}, {}, 0.0, 0}));
  for (;;) {
    const auto frame = client.next(kPatience);
    ASSERT_TRUE(frame) << frame.error().message;
    if (frame->stream != proto::Stream::stats) continue;
    const auto stats = proto::decode_message<proto::StatsData>(frame->data);
    ASSERT_TRUE(stats);
    if (stats->frame_age_us == 0.0 || stats->acked_age_us == 0.0) continue;  // of a second before we followed
    EXPECT_LE(stats->frame_age_us, stats->frame_age_p99_us);
    EXPECT_LE(stats->acked_age_us, stats->acked_age_p99_us);
    EXPECT_LE(stats->frame_age_us, stats->acked_age_p99_us) << "it is sent before it is seen";
    return;
  }
}

TEST(Daemon, CborNeedsAWebSocket) {
  const RunningDaemon daemon;
  const auto reply = daemon.connect().call("stream.subscribe", R"({"stream":"pose","encoding":"cbor"})");
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, "encoding_needs_websocket");
  EXPECT_EQ(reply.error().path, "/params/encoding");
}

TEST(Daemon, TheMethodIsSpringsUntilAnotherIsChosen) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  EXPECT_EQ(client.call<proto::SolverResult>(proto::SolverGet{})->method, "springs");
  const auto hello = client.call<proto::HelloResult>(proto::SessionHello{});
  EXPECT_EQ(hello->features, (std::vector<std::string>{"springs", "reach_tree", "solve", "objects", "undo", "holds",
                                                       "durable", "cameras", "calibrations"}));
  const auto refused = client.call("solver.set", R"({"method":"spring"})");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().path, "/params/method");
  EXPECT_EQ(refused.error().hint, "springs or reach_tree");
  for (const char* method : {"reach_tree", "springs"}) {
    ASSERT_TRUE(client.call("solver.set", std::string(R"({"method":")") + method + "\"}"));
    const auto edited = client.call<proto::EditResult>(hand_goal({0.35, -0.25, 1.2}));
    EXPECT_EQ(pose_at(client, edited->revision).method, method);
  }
  ASSERT_TRUE(client.call("solver.set", R"({"method":"reach_tree"})"));
  EXPECT_EQ(*client.call("solver.set", R"({"method":null})"),
            R"({"method":"springs","iterations":200,"branch_iterations":1})");
}

TEST(Daemon, WhatReachTreeDoesNotDoIsKeptAndSaid) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  ASSERT_TRUE(client.call("solver.set", R"({"method":"reach_tree"})"));
  ASSERT_TRUE(client.call("goal.set", R"({"at":"head","aim":{"axis":[1,0,0],"point":[1,1,1]}})"));
  ASSERT_TRUE(client.call("goal.set", R"({"balance":{"support":["left_foot","right_foot"]},"priority":1})"));
  ASSERT_TRUE(client.call("goal.set",
                          R"({"id":"near","at":"right_hand","position":[0,0,0.1],"relative_to":{"segment":"head"}})"));
  const auto pinned = client.call("figure.pin", R"({"segment":"left_foot","hold":"pose"})");
  ASSERT_TRUE(pinned) << pinned.error().message;
  const auto last = client.call<proto::EditResult>(hand_goal({0.3, -0.3, 1.2}));
  ASSERT_TRUE(last);
  const proto::PoseResult pose = pose_at(client, last->revision);
  for (const char* id : {"body.head.aim", "body.balance", "near"}) {
    const auto* goal = find_goal(pose.pose.goals, id);
    ASSERT_NE(goal, nullptr) << id;
    EXPECT_EQ(goal->state, GoalState::off) << id;
    EXPECT_EQ(goal->touch, goal->target) << id;
  }
  EXPECT_EQ(find_goal(pose.pose.goals, last->id)->state, GoalState::reached);
  EXPECT_EQ(pose.notes, (std::vector<std::string>{"joints count as balls and keep no limits", "pins are not kept",
                                                  "only position goals relative to the world pull; the others are off",
                                                  "priorities count as equal"}));
  const auto goals = client.call("goal.list");
  ASSERT_TRUE(goals);
  EXPECT_NE(goals->find(R"("kind":"aim")"), std::string::npos);
  // They are kept with the scene.
  ASSERT_TRUE(client.call("scene.save", R"({"name":"kinds"})"));
  ASSERT_TRUE(client.call("scene.new", R"({"template":"empty"})"));
  ASSERT_TRUE(client.call("scene.open", R"({"name":"kinds"})"));
  const auto said = [](const std::string& list) {  // what comes anew has another revision
    return std::regex_replace(list, std::regex(R"("entity_revision":\d+)"), "");
  };
  EXPECT_EQ(said(*client.call("goal.list")), said(*goals));
  const auto figure = client.call<proto::FigureResult>(proto::FigureGet{"body"});
  ASSERT_TRUE(figure);
  EXPECT_TRUE(figure->entry.pins.contains("left_foot"));
  EXPECT_NE(client.call("scene.get")->find(R"("pins":{"left_foot":{"hold":"pose")"), std::string::npos);
}

TEST(Daemon, AWrongSegmentIsNamedWithACure) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  const auto before = client.call("scene.get");
  const auto reply = client.call("goal.set", R"({"at":"right_hnd","position":[0,0,1]})");
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, "unknown_segment");
  EXPECT_EQ(reply.error().path, "/params/at");
  EXPECT_NE(reply.error().hint.find("right_hand"), std::string::npos);
  EXPECT_EQ(*before, *client.call("scene.get")) << "a refused edit changes nothing";
}

TEST(Daemon, ThePapersScenesBalanceAndKeepBoneLengthsOverTheWire) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  const auto scenes = client.call<proto::SceneListResult>(proto::SceneList{});
  ASSERT_TRUE(scenes);
  std::vector<std::pair<std::string, std::string>> cases;
  for (const std::string& name : scenes->templates) {
    for (const char* method : {"springs", "reach_tree"}) cases.emplace_back(method, name);
  }
  int papers = 0;
  for (const auto& [method, name] : cases) {
    SCOPED_TRACE(method + " " + name);
    ASSERT_TRUE(client.call("solver.set", R"({"method":")" + method + "\"}"));
    const auto loaded = client.call<proto::RevisionResult>(proto::SceneNew{name});
    ASSERT_TRUE(loaded) << loaded.error().message;
    const proto::PoseResult pose = pose_at(client, loaded->revision);
    EXPECT_EQ(pose.method, method);
    EXPECT_EQ(pose.pose.status, SolveStatus::converged);
    if (name.starts_with("paper/")) {
      ++papers;
      EXPECT_LT(pose.balance_error, 1e-6);
    }
    const auto figure = client.call<proto::FigureResult>(proto::FigureGet{"body"});
    ASSERT_TRUE(figure);
    std::map<std::string, Transform> world;
    for (std::size_t i = 0; i < figure->document.segments.size(); ++i) {
      const Segment& segment = figure->document.segments[i];
      world[segment.name] = pose.pose.world_from_segment[i];
      if (segment.parent.empty()) continue;
      const Vec3 joint = world[segment.parent] * segment.joint.parent_from_joint.position;
      EXPECT_LT(glm::length(joint - world[segment.name].position), 1e-9) << segment.name << " came off its joint";
    }
  }
  EXPECT_EQ(papers, 2 * 8);
}

TEST(Daemon, SavedScenesComeBackWithTheirPose) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  const auto edited = client.call<proto::EditResult>(hand_goal({0.3, -0.4, 1.4}));
  ASSERT_TRUE(edited);
  const proto::PoseResult before = pose_at(client, edited->revision);
  ASSERT_TRUE(client.call("scene.save", R"({"name":"monday"})"));
  ASSERT_TRUE(client.call("scene.new", R"({"template":"empty"})"));
  const auto opened = client.call<proto::RevisionResult>(proto::SceneOpen{"monday"});
  ASSERT_TRUE(opened) << opened.error().message;
  const proto::PoseResult after = pose_at(client, opened->revision);
  ASSERT_EQ(before.pose.q.size(), after.pose.q.size());
  for (std::size_t i = 0; i < before.pose.q.size(); ++i) EXPECT_NEAR(before.pose.q[i], after.pose.q[i], 1e-6);
  EXPECT_EQ(client.call("scene.open", R"({"name":"tuesday"})").error().code, "unknown_scene");
  EXPECT_NE(client.call("scene.list")->find("\"monday\""), std::string::npos);
}

TEST(Daemon, TheSceneStreamIsASnapshotAndThenPatches) {
  const RunningDaemon daemon;
  auto client = daemon.connect(), other = daemon.connect();
  ASSERT_TRUE(client.subscribe({proto::Stream::scene, {}, {}, 0.0, 0}));
  const auto snapshot = client.next(kPatience);
  ASSERT_TRUE(snapshot);
  EXPECT_NE(snapshot->data.find("\"document\""), std::string::npos);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(other.call<proto::EditResult>(hand_goal({0.3, -0.3, 1.0 + 0.01 * i})));
  std::uint64_t seq = snapshot->seq;
  for (int i = 0; i < 20; ++i) {
    const auto patch = client.next(kPatience);
    ASSERT_TRUE(patch);
    EXPECT_EQ(patch->seq, ++seq) << "no edit is left out";
    EXPECT_NE(patch->data.find("/goals/body.right_hand.position"), std::string::npos) << patch->data;
  }
}

// Each newcomer took a number of its own: to all others a frame seemed lost of which they were not told.
TEST(Daemon, WhoSubscribesLaterTakesNoNumberFromOthers) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  ASSERT_TRUE(client.call("camera.set", R"({"id":"main","position":[1,0,1]})"));
  ASSERT_TRUE(client.call("pose.get", "{}"));
  const auto streams = {proto::Stream::pose, proto::Stream::camera, proto::Stream::scene};
  std::map<proto::Stream, std::uint64_t> last;
  const auto subscribe = [&](client::Client& to) {
    for (const proto::Stream stream : streams) ASSERT_TRUE(to.subscribe({stream, {}, {}, 0.0, 0}));
  };
  const auto take = [&](client::Client& from, auto check) {
    for (std::size_t i = 0; i < streams.size(); ++i) {
      const auto frame = from.next(kPatience);
      ASSERT_TRUE(frame) << frame.error().message;
      check(*frame);
    }
  };
  subscribe(client);
  take(client, [&](const proto::Incoming& frame) { last[*frame.stream] = frame.seq; });
  auto first = daemon.connect(), second = daemon.connect();
  for (auto* const other : {&first, &second}) {
    subscribe(*other);
    take(*other, [&](const proto::Incoming& frame) { EXPECT_EQ(frame.seq, last[*frame.stream]); });
  }
  ASSERT_TRUE(first.call("camera.set", R"({"id":"main","position":[2,0,1]})"));
  for (auto* const each : {&client, &first, &second})
    take(*each, [&](const proto::Incoming& frame) { EXPECT_EQ(frame.seq, last[*frame.stream] + 1); });
}

// The stream's frames came by another thread than the reply: an ack that was quick found no subscription.
TEST(Daemon, AStreamIsFollowedAsSoonAsThatIsAnswered) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  const char* const ack = R"({"stream":"stats","seq":1})";
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(client.call("stream.subscribe", R"({"stream":"stats","credit":1})"));
    const auto done = client.call("stream.ack", ack);
    ASSERT_TRUE(done) << i << ": " << done.error().message;
    ASSERT_TRUE(client.call("stream.unsubscribe", R"({"stream":"stats"})"));
    const auto refused = client.call("stream.ack", ack);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, "unknown_stream");
    EXPECT_EQ(refused.error().path, "/params/stream");
  }
}

TEST(Daemon, MirrorAndResetMoveTheFigureAndGoalsStay) {
  const RunningDaemon daemon({}, "empty");
  auto client = daemon.connect();
  const auto set = client.call<proto::EditResult>([] {
    proto::JointSet m;
    m.joint = "left_elbow";
    m.halfplane = 0.3, m.deviation = 1.2, m.twist = 0.1;
    return m;
  }());
  ASSERT_TRUE(set) << set.error().message;
  const auto joint = client.call<proto::JointResult>(proto::JointGet{"", "left_elbow"});
  ASSERT_TRUE(joint);
  EXPECT_NEAR(*joint->halfplane, 0.3, 1e-9);
  EXPECT_NEAR(*joint->deviation, 1.2, 1e-9);
  EXPECT_NEAR(*joint->twist, 0.1, 1e-9);
  ASSERT_TRUE(client.call("pose.mirror"));
  const auto mirrored = client.call<proto::JointResult>(proto::JointGet{"", "right_elbow"});
  ASSERT_TRUE(mirrored);
  EXPECT_NEAR(mirrored->value[0], -joint->value[0], 1e-12);
  EXPECT_NEAR(mirrored->value[1], joint->value[1], 1e-12);
  ASSERT_TRUE(client.call("pose.reset"));
  EXPECT_NEAR(*client.call<proto::JointResult>(proto::JointGet{"", "right_elbow"})->deviation, 0.0, 1e-12);
}

TEST(Daemon, ABatchIsAnsweredInOneLineAndNotificationsNotAtAll) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  EXPECT_TRUE(client.call("session.ping"));
  const std::string command =
      R"(printf '%s\n' '[{"jsonrpc":"2.0","id":"a","method":"session.ping"},{"jsonrpc":"2.0","method":"session.ping"},{"jsonrpc":"2.0","id":7,"method":"nothing"}]' | nc -N 127.0.0.1 )" +
      std::to_string(daemon.port());
  if (std::system("command -v nc >/dev/null") != 0) GTEST_SKIP() << "SKIPPED: nc is not installed";
  FILE* pipe = popen(command.c_str(), "r");
  char text[2048] = {};
  const std::string reply(text, fread(text, 1, sizeof text - 1, pipe));
  pclose(pipe);
  EXPECT_TRUE(reply.starts_with(R"([{"jsonrpc":"2.0","id":"a","result")")) << reply;
  EXPECT_NE(reply.find(R"("id":7,"error":{"code":-32601)"), std::string::npos) << reply;
  EXPECT_EQ(std::count(reply.begin(), reply.end(), '\n'), 1);
}

}  // namespace
}  // namespace posed
