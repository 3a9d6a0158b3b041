// The daemon under its default method: pins, figures that goals tie together, and what a stream does.
#include <gtest/gtest.h>

#include <cmath>

#include "running_daemon.h"
#include "server/daemon/solving.h"
#include "server/solver/tempus.h"

namespace posed {
namespace {

using test::RunningDaemon;

proto::PoseResult pose_of(client::Client& client, const std::string& figure = "") {
  const auto pose = client.call<proto::PoseResult>(proto::PoseGet{figure, {}, 0});
  EXPECT_TRUE(pose) << pose.error().message;
  return pose ? *pose : proto::PoseResult{};
}

const proto::GoalFrame& goal_of(const proto::PoseResult& pose, const std::string& id) {
  static const proto::GoalFrame none{};
  for (const proto::GoalFrame& goal : pose.pose.goals) {
    if (goal.id == id) return goal;
  }
  ADD_FAILURE() << "no goal " << id;
  return none;
}

// In the order of tempus.
constexpr std::size_t kPelvis = 0, kLeftFoot = 14, kRightFoot = 17;

double apart(const Transform& a, const Transform& b) {
  return glm::length(a.position - b.position) + glm::length(a.rotation - b.rotation);
}

TEST(Springs, AStandingFigureReachesWithItsArmAndStaysOnItsFeet) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  const proto::PoseResult before = pose_of(client);
  EXPECT_EQ(goal_of(before, "balance").state, GoalState::reached);
  ASSERT_EQ(before.pose.goals.size(), 1u) << "a pin is no goal of the pose";
  ASSERT_TRUE(client.call("goal.set", R"({"id":"reach","at":"right_hand","position":[0.3,-0.3,1.1]})"));
  const proto::PoseResult after = pose_of(client);
  EXPECT_EQ(goal_of(after, "reach").state, GoalState::reached);
  EXPECT_EQ(goal_of(after, "balance").state, GoalState::reached);
  const auto& from = before.pose.world_from_segment;
  const auto& to = after.pose.world_from_segment;
  EXPECT_LT(apart(from[kLeftFoot], to[kLeftFoot]), 1e-6);
  EXPECT_LT(apart(from[kRightFoot], to[kRightFoot]), 1e-6);
  EXPECT_LT(glm::length(from[kPelvis].position - to[kPelvis].position), 0.01);
  EXPECT_EQ(after.notes, std::vector<std::string>{"all goals are reached: their weights do not matter"});
  EXPECT_FALSE(after.pose.branch_changed);
}

TEST(Springs, AStandingFigureStandsStillAndBendsItsKneesWhenItsHipsAreLowered) {
  const RunningDaemon daemon;
  auto client = daemon.connect();
  const proto::PoseResult before = pose_of(client);
  const BodyTree tree = *BodyTree::build(*tempus(1.75));
  const std::vector<double> start = start_pose(tree);
  for (std::size_t i = 0; i < start.size(); ++i) EXPECT_NEAR(before.pose.q[i], start[i], 1e-9) << i;
  ASSERT_TRUE(client.call("goal.set", R"({"id":"hips","at":"lower_torso","position":[-0.12,0,0.82]})"));
  const proto::PoseResult after = pose_of(client);
  EXPECT_EQ(goal_of(after, "hips").state, GoalState::reached);
  EXPECT_EQ(goal_of(after, "balance").state, GoalState::reached);
  const auto& world = after.pose.world_from_segment;
  EXPECT_LT(apart(before.pose.world_from_segment[kLeftFoot], world[kLeftFoot]), 1e-6);
  const auto left_lower_leg = static_cast<std::size_t>(*tree.find_segment("left_lower_leg"));
  EXPECT_GT(world[left_lower_leg].position.x, 0.1) << "the knee goes forward";
}

TEST(Springs, PinsHoldAgainstEveryGoalAndAreNamedAsTheCause) {
  const RunningDaemon daemon({}, "empty");
  auto client = daemon.connect();
  const Transform before = pose_of(client).pose.world_from_segment[kLeftFoot];
  ASSERT_TRUE(client.call("figure.pin", R"({"segment":"left_foot","hold":"pose"})"));
  ASSERT_TRUE(client.call("goal.set", R"({"id":"pull","at":"left_foot","position":[0.3,0.3,0.5],"weight":1e6})"));
  const proto::PoseResult held = pose_of(client);
  EXPECT_LT(apart(before, held.pose.world_from_segment[kLeftFoot]), 1e-6);
  const proto::GoalFrame& goal = goal_of(held, "pull");
  EXPECT_EQ(goal.state, GoalState::balanced);
  ASSERT_FALSE(goal.causes.empty());
  EXPECT_EQ(goal.causes[0].pin, "left_foot");
  EXPECT_EQ(goal.causes[0].figure, "");
  ASSERT_TRUE(client.call("figure.pin", R"({"segment":"left_foot","hold":null})"));
  EXPECT_EQ(goal_of(pose_of(client), "pull").state, GoalState::reached);
}

TEST(Springs, AGoalRelativeToAnotherFigureMovesBothEnds) {
  const RunningDaemon daemon({}, "empty");
  auto client = daemon.connect();
  ASSERT_TRUE(client.call("figure.set", R"({"id":"other","template":"tempus","stature":1.6})"));
  for (const char* figure : {"body", "other"}) {
    ASSERT_TRUE(client.call("goal.set", std::string(R"({"at":"lower_torso","position":[)") +
                                            (figure[0] == 'b' ? "0,0,0.9275" : "1.2,0,0.9") + R"(],"figure":")" +
                                            figure + "\"}"));
  }
  const proto::PoseResult body = pose_of(client, "body"), other = pose_of(client, "other");
  EXPECT_TRUE(body.notes.empty());
  ASSERT_TRUE(client.call("goal.set", R"({"id":"shake","figure":"body","at":"right_hand","position":[0,0,0],
      "relative_to":{"figure":"other","segment":"left_hand"},"weight":5})"));
  const proto::PoseResult body_now = pose_of(client, "body"), other_now = pose_of(client, "other");
  for (const auto& [was, is] : {std::pair{&body, &body_now}, {&other, &other_now}}) {
    double most = 0.0;
    for (std::size_t i = 0; i < was->pose.world_from_segment.size(); ++i)
      most = std::max(most, apart(was->pose.world_from_segment[i], is->pose.world_from_segment[i]));
    EXPECT_GT(most, 0.05) << "each end gives way";
  }
  // Touch and target are those of the answer: where the hands are now.
  EXPECT_EQ(goal_of(body_now, "shake").state, GoalState::reached);
  EXPECT_EQ(body_now.notes.back(), "goals tie these figures together, and they are solved as one: body other");
  EXPECT_EQ(other_now.pose.goals.size(), 1u) << "a goal is its own figure's";
  ASSERT_TRUE(client.call("goal.remove", R"({"id":"shake"})"));
  EXPECT_TRUE(pose_of(client, "other").notes.empty());
}

TEST(Springs, ASensorThatJumpsIsFollowedInBoundedStepsThoughNoMoreFramesCome) {
  SceneDocument document;
  document.figures["body"].template_name = "tempus";
  Goal& goal = document.goals["hand"];
  goal.figure = "body";
  goal.at.segment = "right_hand";
  goal.payload = PositionTarget{{0.1, -0.3, 0.8}};
  document.goals["root"] = goal;
  document.goals["root"].at.segment = "lower_torso";
  document.goals["root"].payload = PositionTarget{{0, 0, 0.9275}};
  Binding& binding = document.bindings["b"];
  binding.sensor = "simulated:1";
  binding.to.goal = "hand";
  Scene scene;
  ASSERT_TRUE(scene.load(document));
  Solving solving;
  solving.deadline_ns = 10'000'000'000;
  const Clock clock;
  EXPECT_FALSE(solving.solve(scene, false, clock));

  Frame frame;
  frame.device = "simulated";
  Sample& sample = frame.samples.emplace_back();
  sample.station = 1;
  sample.position = {0, -0.2, 2};  // above the head
  ASSERT_TRUE(scene.follow(frame));
  int solves = 0;
  for (bool way_to_go = true; way_to_go && solves < 100; ++solves) {
    const std::vector<double> before = scene.figures().at("body").q;
    way_to_go = solving.solve(scene, true, clock);
    const std::vector<double>& after = scene.figures().at("body").q;
    for (std::size_t i = 7; i < before.size(); ++i) EXPECT_LT(std::abs(after[i] - before[i]), 0.3) << i;
  }
  EXPECT_GT(solves, 2) << "it was no jump";
  const proto::FigurePose pose = solving.message("body");
  EXPECT_EQ(pose.goals.at(0).id, "hand");
  EXPECT_LT(pose.goals.at(0).error, 1e-3);
}

}  // namespace
}  // namespace posed
