// What the documentation shows and the viewer's tests read is what the daemon takes and says.
#include "tests/proto/examples.h"

#include "server/solver/kinematics.h"
#include "server/solver/orientation.h"
#include "server/solver/tempus.h"
#include "tests/proto/proto_fixture.h"

namespace posed::proto {
namespace {

// Reads a result as `Message` and says it anew.
template <class Message>
std::string said_anew(const std::string& id, const std::string& result) {
  const Result<Message> message = decode_message<Message>(result);
  if (!message) return message.error().path + ": " + message.error().message;
  return encode_reply(id, *message);
}
std::string said_empty(const std::string& id, const std::string&) {
  return encode_reply(id, EmptyResult{});
}

using SayAnew = std::string (*)(const std::string& id, const std::string& result);
const std::map<std::string, SayAnew> kResults{{"session.hello", said_anew<HelloResult>},
                                              {"session.ping", said_anew<PingResult>},
                                              {"session.status", said_anew<StatusResult>},
                                              {"session.list", said_anew<SessionListResult>},
                                              {"figure.set", said_anew<EditResult>},
                                              {"figure.get", said_anew<FigureResult>},
                                              {"figure.list", said_anew<FigureListResult>},
                                              {"figure.remove", said_anew<EditResult>},
                                              {"figure.pin", said_anew<EditResult>},
                                              {"goal.set", said_anew<EditResult>},
                                              {"goal.get", said_anew<GoalResult>},
                                              {"goal.list", said_anew<GoalListResult>},
                                              {"goal.remove", said_anew<EditResult>},
                                              {"goal.clear", said_anew<ClearResult>},
                                              {"object.set", said_anew<EditResult>},
                                              {"object.get", said_anew<ObjectResult>},
                                              {"object.list", said_anew<ObjectListResult>},
                                              {"object.remove", said_anew<EditResult>},
                                              {"binding.set", said_anew<EditResult>},
                                              {"binding.get", said_anew<BindingResult>},
                                              {"binding.list", said_anew<BindingListResult>},
                                              {"binding.remove", said_anew<EditResult>},
                                              {"camera.set", said_anew<EditResult>},
                                              {"camera.get", said_anew<CameraResult>},
                                              {"camera.list", said_anew<CameraListResult>},
                                              {"camera.remove", said_anew<EditResult>},
                                              {"joint.set", said_anew<EditResult>},
                                              {"joint.get", said_anew<JointResult>},
                                              {"pose.get", said_anew<PoseResult>},
                                              {"pose.set", said_anew<EditResult>},
                                              {"pose.reset", said_anew<EditResult>},
                                              {"pose.mirror", said_anew<EditResult>},
                                              {"solver.get", said_anew<SolverResult>},
                                              {"solver.set", said_anew<SolverResult>},
                                              {"solve", said_anew<SolveResult>},
                                              {"solve.batch", said_anew<SolveBatchResult>},
                                              {"scene.get", said_anew<SceneResult>},
                                              {"scene.new", said_anew<RevisionResult>},
                                              {"scene.list", said_anew<SceneListResult>},
                                              {"scene.save", said_anew<RevisionResult>},
                                              {"scene.open", said_anew<RevisionResult>},
                                              {"scene.remove", said_empty},
                                              {"tracker.list", said_anew<TrackerListResult>},
                                              {"tracker.grab", said_anew<TrackerGrabResult>},
                                              {"tracker.release", said_empty},
                                              {"tracker.configure", said_empty},
                                              {"tracker.reset", said_empty},
                                              {"tracker.touch", said_anew<TouchResult>},
                                              {"tracker.align", said_anew<CalibrationResult>},
                                              {"tracker.tip", said_anew<CalibrationResult>},
                                              {"tracker.boresight", said_anew<CalibrationResult>},
                                              {"tracker.forget", said_empty},
                                              {"stream.subscribe", said_anew<SubscribeResult>},
                                              {"stream.unsubscribe", said_anew<SubscribeResult>},
                                              {"stream.ack", said_empty},
                                              {"goal.grab", said_anew<GrabResult>},
                                              {"goal.release", said_empty},
                                              {"edit.apply", said_anew<ApplyResult>},
                                              {"edit.undo", said_anew<StepResult>},
                                              {"edit.redo", said_anew<StepResult>},
                                              {"edit.history", said_anew<HistoryResult>}};

TEST(Examples, EveryMethodHasOne) {
  for (const Params& message : every_message()) {
    const std::string name = method_of(message).name;
    ASSERT_TRUE(examples().contains(name)) << name;
    EXPECT_EQ(examples().at(name).at("request").at("method"), name);
    EXPECT_TRUE(kResults.contains(name)) << name;
  }
}

// "goal.set" and more of the same, "goal.set.aim".
TEST(Examples, EveryFileIsOfAMethodOrANotice) {
  for (const auto& [name, example] : examples()) {
    if (example.contains("notice") || name == "error") continue;
    const std::string method = example.at("request").at("method");
    EXPECT_TRUE(kResults.contains(method) && (name == method || name.starts_with(method + "."))) << name;
  }
}

TEST(Examples, EveryKindOfGoalHasOne) {
  for (const std::string kind : kGoalKindNames) {
    const std::string name = kind == "position" ? "goal.set" : "goal.set." + kind;
    ASSERT_TRUE(examples().contains(name)) << name;
    const GoalEdit edit = std::get<GoalSet>(accepted(examples().at(name).at("request").dump()).params).edit;
    const Result<GoalPayload> payload = payload_after(nullptr, edit);
    ASSERT_TRUE(payload) << name;
    EXPECT_EQ(name_of(kind_of(*payload)), kind);
  }
}

TEST(Examples, RequestsAreTakenWithAllTheirFields) {
  for (const auto& [name, example] : examples()) {
    if (!example.contains("request")) continue;
    SCOPED_TRACE(name);
    const Request request = accepted(example.at("request").dump());
    const json anew = json::parse(encode_request(1, request.params)).at("params");
    EXPECT_EQ(encode_request(1, accepted(encode_request(1, request.params)).params), encode_request(1, request.params));
    for (const auto& [key, value] : example.at("request").at("params").items()) {
      if (key == "if_revision") {
        EXPECT_EQ(request.if_revision, value);
      } else if (key != "scene") {
        ASSERT_TRUE(anew.contains(key)) << key;
        EXPECT_EQ(anew.at(key), json::parse(value.dump())) << key;
      }
    }
  }
}

TEST(Examples, RepliesAreWhatTheDaemonSays) {
  for (const auto& [name, example] : examples()) {
    if (!example.contains("request") || name == "error") continue;
    SCOPED_TRACE(name);
    const SayAnew say_anew = kResults.at(example.at("request").at("method"));
    const std::string id = example.at("request").at("id").dump();
    const std::string reply = say_anew(id, example.at("reply").at("result").dump());
    ASSERT_TRUE(json::accept(reply)) << reply;
    // Field for field, in the same order.
    EXPECT_EQ(OrderedJson::parse(reply), example.at("reply")) << reply;
  }
}

TEST(Examples, TheErrorIsWhatTheDaemonSays) {
  const OrderedJson& reply = examples().at("error").at("reply");
  const Result<Incoming> in = decode_incoming(reply.dump());
  ASSERT_TRUE(in && in->error);
  EXPECT_EQ(OrderedJson::parse(encode_error(reply.at("id").dump(), *in->error)), reply);
}

TEST(Examples, NoticesAreWhatTheDaemonSays) {
  const auto anew = [](const std::string& name) -> std::string {
    const Result<Incoming> in = decode_incoming(examples().at(name).at("notice").dump());
    if (!in) return in.error().message;
    const json data = json::parse(in->data, nullptr, false);
    if (name == "stream.frame.pose") return encode_pose_frame(in->seq, *decode_message<PoseData>(in->data), {});
    if (name == "stream.frame.tracker") return encode_tracker_frame(in->seq, *decode_message<TrackerData>(in->data));
    if (name == "stream.frame.camera") return encode_camera_frame(in->seq, *decode_message<CameraData>(in->data));
    if (name == "stream.frame.stats") return encode_stats_frame(in->seq, *decode_message<StatsData>(in->data));
    if (name == "stream.frame.scene") {
      const SceneDocument scene = *decode_scene(data.at("document").dump());
      return encode_scene_snapshot(in->seq, data.at("revision"), encode_scene(scene));
    }
    if (name == "stream.frame.scene-patch") {
      return encode_scene_patch(in->seq, data.at("from_revision"), data.at("revision"),
                                data.at("by").get<std::string>(), data.at("patch").dump());
    }
    if (name == "solve.progress") {
      const auto& params = examples().at(name).at("notice").at("params");
      return encode_progress(params.at("id").dump(), in->done, in->of);
    }
    return encode_lost(*in->stream, in->dropped);
  };
  int notices = 0;
  for (const auto& [name, example] : examples()) {
    if (!example.contains("notice")) continue;
    SCOPED_TRACE(name);
    const std::string line = anew(name);
    ASSERT_TRUE(json::accept(line)) << line;
    EXPECT_EQ(json::parse(line), json::parse(example.at("notice").dump()));
    ++notices;
  }
  EXPECT_EQ(notices, 8);
}

TEST(Examples, ThePatchFitsTheSnapshot) {
  const json before = json::parse(examples().at("stream.frame.scene").dump()).at("notice").at("params").at("data");
  const json patch = json::parse(examples().at("stream.frame.scene-patch").dump()).at("notice").at("params").at("data");
  EXPECT_EQ(patch.at("from_revision"), before.at("revision"));
  const json after = before.at("document").patch(patch.at("patch"));
  EXPECT_TRUE(decode_scene(after.dump()));
  EXPECT_NE(after, before.at("document"));
}

TEST(Examples, TheFigureIsTempus) {
  const OrderedJson& result = examples().at("figure.get").at("reply").at("result");
  EXPECT_EQ(result.at("document"), OrderedJson::parse(encode_figure(*tempus(result.at("stature")))));
}

TEST(Examples, TheElbowsQuaternionIsThatOfItsAngles) {
  const auto result = decode_message<JointResult>(examples().at("joint.get").at("reply").at("result").dump());
  const BodyTree tree = *BodyTree::build(*tempus(1.75));
  const Vec3 limb = tree.segment(*tree.find_joint(result->joint)).touch_point;
  const Quat expected = quat_from_orientation({*result->halfplane, *result->deviation, *result->twist}, limb);
  EXPECT_LT(glm::length(quat_from_xyzw(result->value) - expected), 1e-15);
}

TEST(Examples, ThePoseIsThatOfItsJointValues) {
  const auto result = decode_message<PoseResult>(examples().at("pose.get").at("reply").at("result").dump());
  const BodyTree tree = *BodyTree::build(*tempus(1.75));
  ASSERT_TRUE(check_q(tree, result->pose.q));
  std::vector<Transform> world(static_cast<std::size_t>(tree.size()));
  forward_kinematics(tree, result->pose.q, world);
  ASSERT_EQ(result->pose.world_from_segment.size(), world.size());
  for (std::size_t i = 0; i < world.size(); ++i) {
    EXPECT_LT(glm::length(world[i].position - result->pose.world_from_segment[i].position), 1e-12) << i;
    EXPECT_LT(glm::length(world[i].rotation - result->pose.world_from_segment[i].rotation), 1e-12) << i;
  }
  for (const GoalFrame& goal : result->pose.goals) {
    EXPECT_NEAR(goal.error, glm::length(goal.target - goal.touch), 1e-12) << goal.id;
  }
}

}  // namespace
}  // namespace posed::proto
