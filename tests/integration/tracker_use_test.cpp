// What trackers are for: the paper's three uses from a sensor to a viewer's stream, leases, and calibrations that
// outlive the daemon.
#include <gtest/gtest.h>

#include <thread>

#include "running_daemon.h"
#include "server/calibration/rigid_fit.h"

namespace posed {
namespace {

using test::RunningDaemon;
constexpr auto kPatience = std::chrono::seconds(60);

template <class Data>
Data next_of(client::Client& client, proto::Stream stream) {
  for (;;) {
    const auto frame = client.next(kPatience);
    if (!frame) throw std::runtime_error(frame.error().message);
    if (frame->stream != stream) continue;
    const auto data = proto::decode_message<Data>(frame->data);
    if (!data) throw std::runtime_error(data.error().message);
    return *data;
  }
}

Error refused(client::Client& client, const std::string& method, const std::string& params) {
  const auto reply = client.call(method, params);
  EXPECT_FALSE(reply) << method << params;
  return reply ? Error{} : reply.error();
}

TEST(TrackerUse, ABoundCameraIsWhereTheSensorIsInItsStream) {
  const RunningDaemon daemon({"simulated:3"});
  auto client = daemon.connect();
  ASSERT_TRUE(client.call("camera.set", R"({"id":"main","position":[2,0,1.5],"fov_y":0.9})"));
  ASSERT_TRUE(client.call("binding.set", R"({"sensor":"simulated:1","to":{"camera":"main"}})"));
  ASSERT_TRUE(client.subscribe({proto::Stream::camera, {}, {}, 0.0, 0}));
  ASSERT_TRUE(client.subscribe({proto::Stream::tracker, {}, {}, 0.0, 0}));
  std::map<Nanoseconds, Transform> sensors;
  int matched = 0;
  while (matched < 20) {
    const auto frame = client.next(kPatience);
    ASSERT_TRUE(frame) << frame.error().message;
    if (frame->stream == proto::Stream::tracker) {
      const auto data = proto::decode_message<proto::TrackerData>(frame->data);
      sensors[data->t_ns] = {data->sensors[0].position, data->sensors[0].rotation};
      continue;
    }
    const auto data = proto::decode_message<proto::CameraData>(frame->data);
    ASSERT_EQ(data->cameras.size(), 1u);
    EXPECT_EQ(data->cameras[0].camera, "main");
    EXPECT_NEAR(data->cameras[0].fov_y, 0.9, 1e-6);
    const auto sensor = sensors.find(data->t_ns);
    if (sensor == sensors.end()) continue;
    ++matched;
    EXPECT_LT(glm::length(data->cameras[0].world_from_camera.position - sensor->second.position), 2e-6);
    EXPECT_GT(std::abs(glm::dot(data->cameras[0].world_from_camera.rotation, sensor->second.rotation)), 1.0 - 1e-6);
  }
}

TEST(TrackerUse, ALedObjectIsInThePosesWithWhatRidesOnIt) {
  const RunningDaemon daemon({"simulated:3"});
  auto client = daemon.connect();
  ASSERT_TRUE(client.call("object.set", R"({"id":"box","position":[0.6,-0.2,1.1]})"));
  ASSERT_TRUE(client.call("goal.set",
                          R"({"id":"reach","at":"right_hand","position":[0,0,0.1],"relative_to":{"object":"box"}})"));
  ASSERT_TRUE(
      client.call("binding.set", R"({"id":"b","sensor":"simulated:1","to":{"object":"box"},"mode":"relative"})"));
  ASSERT_TRUE(client.subscribe({proto::Stream::pose, {}, {"goals", "objects"}, 0.0, 0}));
  double came = 0.0;
  std::optional<Transform> last;
  while (came < 0.01) {
    const auto data = next_of<proto::PoseData>(client, proto::Stream::pose);
    if (data.objects.empty()) continue;  // the sensor has not spoken yet
    ASSERT_EQ(data.objects.size(), 1u);
    EXPECT_EQ(data.objects[0].object, "box");
    const Transform& box = data.objects[0].world_from_object;
    for (const proto::GoalFrame& goal : data.figures[0].goals) {
      if (goal.id != "reach") continue;
      EXPECT_LT(glm::length(box * Vec3(0, 0, 0.1) - goal.target), 3e-6);
    }
    if (last) {
      came += glm::length(box.position - last->position);
      EXPECT_GT(glm::dot(box.rotation, last->rotation), 0.0) << "a quaternion keeps its sign";
    }
    last = box;
  }
  ASSERT_TRUE(client.call("binding.remove", R"({"id":"b"})"));
  const auto left = client.call<proto::ObjectResult>(proto::ObjectGet{"box"});
  ASSERT_TRUE(left);
  for (;;) {
    const auto data = next_of<proto::PoseData>(client, proto::Stream::pose);
    if (data.objects.empty()) break;
    last = data.objects[0].world_from_object;
  }
  EXPECT_LT(glm::length(left->object.world_from_object.position - last->position), 2e-6)
      << "it stays where it was let go";
}

TEST(TrackerUse, ACameraOnAHeadMovesAsTheHeadDoes) {
  const RunningDaemon daemon({"simulated:3"});
  auto client = daemon.connect();
  const auto figure = client.call<proto::FigureResult>(proto::FigureGet{"body"});
  ASSERT_TRUE(figure);
  std::size_t head = 0;
  while (figure->document.segments[head].name != "head") ++head;
  ASSERT_TRUE(client.call("camera.set",
                          R"({"id":"eyes","position":[0.1,0,0.05],"relative_to":{"figure":"body","segment":"head"}})"));
  ASSERT_TRUE(client.call("goal.set", R"({"id":"reach","at":"right_hand","position":[0.6,-0.3,1.2]})"));
  ASSERT_TRUE(client.call("binding.set", R"({"sensor":"simulated:1","to":{"goal":"reach"},"scale":1.5})"));
  ASSERT_TRUE(client.subscribe({proto::Stream::camera, {}, {}, 0.0, 0}));
  ASSERT_TRUE(client.subscribe({proto::Stream::pose, {}, {"world_from_segment"}, 0.0, 0}));
  std::map<Nanoseconds, Transform> heads;
  for (int matched = 0; matched < 20;) {
    const auto frame = client.next(kPatience);
    ASSERT_TRUE(frame) << frame.error().message;
    if (frame->stream == proto::Stream::pose) {
      const auto data = proto::decode_message<proto::PoseData>(frame->data);
      heads[data->t_ns] = data->figures[0].world_from_segment[head];
      continue;
    }
    const auto data = proto::decode_message<proto::CameraData>(frame->data);
    const auto at = heads.find(data->t_ns);
    if (data->cameras.empty() || at == heads.end()) continue;
    ++matched;
    EXPECT_LT(glm::length(data->cameras[0].world_from_camera.position - at->second * Vec3(0.1, 0, 0.05)), 3e-6);
  }
}

// A camera that came back to where the last follower had seen it was not told to the next one.
TEST(TrackerUse, WhoComesLaterSeesWhereACameraIs) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  const auto put = [&](double x) {
    EXPECT_TRUE(client.call("camera.set", R"({"id":"main","position":[)" + std::to_string(x) + ",0,0]}"));
    EXPECT_TRUE(client.call("pose.get", "{}")) << "it is solved, and whatever follows from it is sent";
  };
  const auto seen = [&] { return next_of<proto::CameraData>(client, proto::Stream::camera).cameras.at(0); };
  put(1);
  ASSERT_TRUE(client.subscribe({proto::Stream::camera, {}, {}, 0.0, 0}));
  EXPECT_EQ(seen().world_from_camera.position.x, 1.0);
  ASSERT_TRUE(client.unsubscribe(proto::Stream::camera));
  put(2);
  ASSERT_TRUE(client.subscribe({proto::Stream::camera, {}, {}, 0.0, 0}));
  EXPECT_EQ(seen().world_from_camera.position.x, 2.0);
  put(1);
  EXPECT_EQ(seen().world_from_camera.position.x, 1.0);
}

TEST(TrackerUse, ABoundJointTurnsItsSegmentAsTheSensorIs) {
  const RunningDaemon daemon({"simulated:3"}, "empty");
  auto client = daemon.connect();
  const auto figure = client.call<proto::FigureResult>(proto::FigureGet{"body"});
  ASSERT_TRUE(figure);
  std::size_t head = 0;
  while (figure->document.segments[head].name != "head") ++head;
  const std::string joint = figure->document.segments[head].joint.name;
  // Only a little of the sensor's turn, so that the joint's limits are no matter: a sensor that hardly turns in rz.
  const auto bound =
      client.call("binding.set", R"({"sensor":"simulated:1","to":{"joint":")" + joint + R"("},"mode":"relative"})");
  ASSERT_TRUE(bound) << bound.error().message;
  const auto revision = client.call<proto::StatusResult>(proto::SessionStatus{})->revision;
  ASSERT_TRUE(client.subscribe({proto::Stream::pose, {}, {"world_from_segment", "goals"}, 0.0, 0}));
  std::optional<Quat> first;
  for (double turned = 0.0; turned < 0.05;) {
    const auto data = next_of<proto::PoseData>(client, proto::Stream::pose);
    EXPECT_EQ(data.revision, revision) << "live motion is no edit";
    EXPECT_TRUE(data.figures[0].goals.empty()) << "a binding is no goal";
    const Quat now = data.figures[0].world_from_segment[head].rotation;
    if (!first) first = now;
    turned = 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(*first, now))));
  }
}

TEST(TrackerUse, AHeldJointStaysWhereAGoalPulls) {
  const RunningDaemon daemon;  // its feet are pinned: what is out of reach stretches the arm
  auto client = daemon.connect();
  ASSERT_TRUE(client.call(
      "joint.set", R"({"joint":"left_elbow","value":[0,0,-0.5646424733950354,0.8253356149096783],"hold":true})"));
  auto joint = client.call<proto::JointResult>(proto::JointGet{"", "left_elbow"});
  ASSERT_TRUE(joint);
  ASSERT_TRUE(joint->hold);
  EXPECT_FALSE(joint->hold->weight);
  ASSERT_TRUE(client.call("goal.set", R"({"id":"reach","at":"left_hand","position":[1.5,0.3,1.2]})"));
  ASSERT_TRUE(client.call("pose.get", "{}"));
  joint = client.call<proto::JointResult>(proto::JointGet{"", "left_elbow"});
  EXPECT_NEAR(*joint->deviation, 1.2, 1e-3) << "the arm would stretch";
  ASSERT_TRUE(client.call("joint.set", R"({"joint":"left_elbow","hold":null})"));
  ASSERT_TRUE(client.call("pose.get", "{}"));
  joint = client.call<proto::JointResult>(proto::JointGet{"", "left_elbow"});
  EXPECT_FALSE(joint->hold);
  EXPECT_LT(*joint->deviation, 0.8);
}

TEST(TrackerUse, ALeaseKeepsOthersOut) {
  const RunningDaemon daemon({"simulated:3"});
  auto ana = daemon.connect(), ben = daemon.connect();
  ASSERT_TRUE(ana.call("session.hello", R"({"protocol":1,"user":"ana"})"));
  ASSERT_TRUE(ana.call("tracker.grab", R"({"tracker":"simulated"})"));
  for (const auto& [method, params] : {std::pair{"tracker.grab", R"({"tracker":"simulated"})"},
                                       {"tracker.configure", R"({"tracker":"simulated","calibration":null})"},
                                       {"tracker.reset", R"({"tracker":"simulated"})"},
                                       {"tracker.align", R"({"tracker":"simulated","points":[]})"},
                                       {"tracker.release", R"({"tracker":"simulated"})"}}) {
    const Error error = refused(ben, method, params);
    EXPECT_EQ(error.code, "held") << method;
    EXPECT_NE(error.message.find("ana"), std::string::npos) << error.message;
    EXPECT_EQ(error.path, "/params/tracker");
  }
  const auto list = ben.call<proto::TrackerListResult>(proto::TrackerList{});
  ASSERT_TRUE(list);
  EXPECT_EQ(list->trackers[0].held_by, "ana");
  EXPECT_TRUE(ben.call("tracker.reset", R"({"tracker":"simulated","force":true})"));
  { const auto gone = std::move(ana); }
  for (int i = 0; !ben.call("tracker.grab", R"({"tracker":"simulated"})"); ++i) {
    ASSERT_LT(i, 6000) << "who is gone holds nothing";
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(refused(ben, "tracker.grab", R"({"tracker":"simulatd"})").code, "unknown_tracker");
  EXPECT_EQ(refused(ben, "tracker.configure", R"({"tracker":"simulated","rate_hz":120})").code, "not_available");
  EXPECT_EQ(refused(ben, "tracker.configure", R"({"tracker":"simulated","calibration":"x"})").code,
            "unknown_calibration");
  EXPECT_EQ(refused(ben, "tracker.touch", R"({"sensor":"simulated:9"})").code, "unknown_sensor");
}

TEST(TrackerUse, ACalibrationPutsSamplesInTheWorldAndOutlivesTheDaemon) {
  test::TemporaryFolder folder;
  Config config;
  config.port = 0;
  config.trackers = {"simulated:3"};
  config.data = folder.path();
  config.viewer = folder.path();
  config.scenes = POSED_SOURCE_DIR "/server/scene/templates";
  config.log = LogLevel::error;
  const auto with_daemon = [&config](const auto& act) {
    Daemon daemon(config);
    std::thread thread([&daemon] { daemon.run(false); });
    auto client = client::Client::connect("tcp://127.0.0.1:" + std::to_string(daemon.port()), kPatience);
    if (client) act(*client);
    EXPECT_TRUE(client);
    daemon.stop();
    thread.join();
  };
  const Transform world_from_source{{10, 20, 30}, quat_about(kZ, M_PI / 2)};
  const auto expect_in_the_world = [&](client::Client& client) {
    EXPECT_TRUE(client.subscribe({proto::Stream::tracker, {}, {}, 0.0, 0}));
    const auto data = next_of<proto::TrackerData>(client, proto::Stream::tracker);
    const Vec3 source = inverse(world_from_source) * data.sensors[0].position;
    EXPECT_LT(glm::length(source - Vec3(0.45, -0.25, 1.2)), 0.5) << "where the simulated sensor swings";
    EXPECT_TRUE(client.unsubscribe(proto::Stream::tracker));
  };
  with_daemon([&](client::Client& client) {
    ASSERT_TRUE(client.call("session.hello", R"({"protocol":1,"user":"ana"})"));
    proto::TrackerAlign align;
    align.tracker = "simulated";
    align.name = "monday";
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      align.points.push_back({p, world_from_source * p, 0.0});
    const auto aligned = client.call<proto::CalibrationResult>(align);
    ASSERT_TRUE(aligned) << aligned.error().message;
    EXPECT_EQ(aligned->calibration.author, "ana");
    EXPECT_LT(aligned->calibration.residual_m, 1e-9);
    EXPECT_GT(aligned->calibration.utc_ns, 0);
    expect_in_the_world(client);

    // The simulated sensor swings, so its tip can not be told by pivoting; where it is known it can be said.
    ASSERT_TRUE(client.call("tracker.tip", R"({"sensor":"simulated:2","offset":[0.1,0,0]})"));
    const auto bore =
        client.call<proto::CalibrationResult>(proto::TrackerBoresight{"simulated:1", "", false, 50, quat_identity()});
    ASSERT_TRUE(bore) << bore.error().message;
    EXPECT_TRUE(bore->calibration.sensors.at("1").boresight);
    EXPECT_TRUE(bore->calibration.sensors.at("2").tip) << "what was measured before stays";
    proto::TrackerTouch touch{"simulated:1", false, 50, Vec3(10, 20, 30)};
    const auto touched = client.call<proto::TouchResult>(touch);
    ASSERT_TRUE(touched) << touched.error().message;
    EXPECT_GT(touched->samples, 0);
    EXPECT_NEAR(*touched->off_m, glm::length(touched->position - Vec3(10, 20, 30)), 1e-9);
    EXPECT_LT(glm::length(world_from_source * touched->source - touched->position), 1e-6);

    // No new scene and no undo changes where a tracker stands.
    ASSERT_TRUE(client.call("scene.new", R"({"template":"empty"})"));
    expect_in_the_world(client);
    EXPECT_EQ(
        refused(client, "tracker.align", R"({"tracker":"simulated","points":[{"source":[0,0,0],"world":[0,0,0]}]})")
            .path,
        "/params/points");
  });
  with_daemon([&](client::Client& client) {
    const auto list = client.call<proto::TrackerListResult>(proto::TrackerList{});
    ASSERT_TRUE(list);
    ASSERT_EQ(list->trackers.size(), 1u);
    EXPECT_EQ(list->trackers[0].calibration, "monday");
    ASSERT_EQ(list->trackers[0].calibrations.size(), 1u);
    EXPECT_EQ(list->trackers[0].calibrations[0].author, "ana");
    EXPECT_EQ(list->trackers[0].calibrations[0].points.size(), 4u);
    expect_in_the_world(client);
    ASSERT_TRUE(client.call("tracker.configure", R"({"tracker":"simulated","calibration":null})"));
  });
  with_daemon([&](client::Client& client) {
    const auto list = client.call<proto::TrackerListResult>(proto::TrackerList{});
    ASSERT_TRUE(list);
    EXPECT_EQ(list->trackers[0].calibration, "");
    EXPECT_EQ(list->trackers[0].calibrations.size(), 1u) << "kept, and not chosen";
    ASSERT_TRUE(client.call("tracker.configure", R"({"tracker":"simulated","calibration":"monday"})"));
    const Error in_use = refused(client, "tracker.forget", R"({"tracker":"simulated","name":"monday"})");
    EXPECT_EQ(in_use.code, "in_use");
    EXPECT_EQ(in_use.path, "/params/name");
    EXPECT_EQ(refused(client, "tracker.forget", R"({"tracker":"simulated","name":"sunday"})").code,
              "unknown_calibration");
    ASSERT_TRUE(client.call("tracker.configure", R"({"tracker":"simulated","calibration":null})"));
    ASSERT_TRUE(client.call("tracker.forget", R"({"tracker":"simulated","name":"monday"})"));
  });
  with_daemon([&](client::Client& client) {
    const auto list = client.call<proto::TrackerListResult>(proto::TrackerList{});
    ASSERT_TRUE(list);
    EXPECT_TRUE(list->trackers[0].calibrations.empty()) << "forgotten on the disk, too";
  });
}

TEST(TrackerUse, TheSecondOfAKindHasANameOfItsOwn) {
  const RunningDaemon daemon({"simulated:1", "simulated:2", "left=simulated:3"});
  auto client = daemon.connect();
  const auto list = client.call<proto::TrackerListResult>(proto::TrackerList{});
  ASSERT_TRUE(list);
  std::vector<std::string> names;
  for (const auto& tracker : list->trackers) names.push_back(tracker.tracker);
  EXPECT_EQ(names, (std::vector<std::string>{"left", "simulated", "simulated-2"}));
  // Each tells how evenly its samples come.
  ASSERT_TRUE(client.subscribe({proto::Stream::stats, {}, {}, 0.0, 0}));
  for (;;) {
    const auto stats = next_of<proto::StatsData>(client, proto::Stream::stats);
    if (stats.trackers.size() < 3) continue;
    for (const auto& tracker : stats.trackers) {
      EXPECT_GT(tracker.rate_hz, 0.0);
      EXPECT_GE(tracker.lag_us, tracker.jitter_us);
    }
    break;
  }
}

}  // namespace
}  // namespace posed
