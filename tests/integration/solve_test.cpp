// Stateless solves: one, many, and what becomes of bad ones.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "running_daemon.h"
#include "server/solver/tempus.h"

namespace posed {
namespace {

using test::RunningDaemon;
using Json = nlohmann::json;

class Solve : public testing::Test {
 protected:
  proto::SolveResult solve(const std::string& params) {
    const auto text = client.call("solve", params);
    EXPECT_TRUE(text) << text.error().message << " at " << text.error().path;
    return text ? *proto::decode_message<proto::SolveResult>(*text) : proto::SolveResult{};
  }
  Error refused(const std::string& method, const std::string& params) {
    const auto text = client.call(method, params);
    EXPECT_FALSE(text) << params;
    return text ? Error{} : text.error();
  }

  RunningDaemon daemon{{}, "standing"};
  client::Client client = daemon.connect();
};

std::string batch(int problems, const std::string& more) {
  std::string text = R"({"figure":{"template":"tempus","stature":1.75},"problems":[)";
  for (int i = 0; i < problems; ++i) {
    text += std::string(i > 0 ? "," : "") + R"({"goals":[{"at":"right_hand","position":[)" +
            std::to_string(0.2 + 0.0001 * i) + R"(,-0.3,1.2]},{"at":"lower_torso","position":[0,0,0.9275]}]})";
  }
  return text + "]" + more + "}";
}

TEST_F(Solve, ColdNeedsNoSceneAndTouchesNone) {
  const std::string before = *client.call("scene.get");
  const auto result = solve(R"({"figure":{"template":"tempus","stature":1.75},
      "goals":[{"at":"right_hand","position":[0.4,-0.3,1.3]},{"id":"root","at":"lower_torso","position":[0,0,0.9275]}]})");
  ASSERT_TRUE(result.q && result.goals && result.world_from_segment);
  EXPECT_EQ(result.world_from_segment->size(), 18u);
  ASSERT_EQ(result.goals->size(), 2u);
  EXPECT_EQ((*result.goals)[0].id, "g1");
  EXPECT_EQ((*result.goals)[1].id, "root");
  for (const auto& goal : *result.goals) EXPECT_EQ(goal.state, GoalState::reached);
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_EQ(result.method, "springs");
  EXPECT_GT(result.iterations, 0);
  EXPECT_EQ(*client.call("scene.get"), before);
}

TEST_F(Solve, TheSameProblemHasTheSameAnswer) {
  const std::string problem = R"({"figure":{"template":"tempus","stature":1.75},"fields":["q"],
      "goals":[{"at":"right_hand","position":[2,-0.3,1.3]},{"at":"left_foot","position":[0,0.1,0.1]}]})";
  const auto first = solve(problem), again = solve(problem);
  EXPECT_EQ(first.q, again.q);
  EXPECT_FALSE(first.goals);
  EXPECT_FALSE(first.world_from_segment);
}

TEST_F(Solve, WarmBeginsWhereItIsTold) {
  // No goals: the start is the answer.
  const BodyTree tree = *BodyTree::build(*tempus(1.75));
  const auto current = solve(R"({"figure":"body","start":"current","goals":[],"pins":{}})");
  const auto rest = solve(R"({"figure":"body","start":"rest","goals":[],"pins":{}})");
  EXPECT_EQ(*rest.q, tree.rest());
  const std::vector<double> start = start_pose(tree);
  for (std::size_t i = 0; i < start.size(); ++i) EXPECT_NEAR((*current.q)[i], start[i], 1e-9);
  Json q = start;
  q[0] = 0.5;
  const auto given =
      solve(R"({"figure":{"template":"tempus","stature":1.75},"start":{"q":)" + q.dump() + R"(},"goals":[]})");
  EXPECT_EQ((*given.q)[0], 0.5);
  EXPECT_EQ(refused("solve", R"({"start":{"q":[1,2]},"goals":[]})").path, "/params/start/q");
  EXPECT_EQ(refused("solve", R"({"figure":{"template":"tempus"},"start":"current","goals":[]})").path, "/params/start");
}

TEST_F(Solve, PinsAreTheFiguresOwnOrThoseThatAreSaid) {
  const std::string pull = R"("goals":[{"at":"left_foot","position":[0.5,0.4,0.4],"weight":1000}])";
  const auto own = solve(R"({"figure":"body","start":"current",)" + pull + "}");
  EXPECT_EQ((*own.goals)[0].state, GoalState::balanced);
  ASSERT_FALSE((*own.goals)[0].causes.empty());
  EXPECT_EQ((*own.goals)[0].causes[0].pin, "left_foot");
  EXPECT_EQ((*solve(R"({"figure":"body","start":"current","pins":{},)" + pull + "}").goals)[0].state,
            GoalState::reached);
  const auto said =
      solve(R"({"figure":{"template":"tempus"},"start":"rest","pins":{"left_foot":{"hold":"position"}},)" + pull + "}");
  EXPECT_EQ((*said.goals)[0].state, GoalState::balanced);
  EXPECT_EQ(refused("solve", R"({"goals":[],"pins":{"left_foo":{"hold":"pose"}}})").path, "/params/pins/left_foo");
}

TEST_F(Solve, EitherMethodSolves) {
  const auto result = solve(R"({"method":"reach_tree","goals":[{"at":"right_hand","position":[0.4,-0.3,1.3]}]})");
  EXPECT_EQ(result.method, "reach_tree");
  EXPECT_EQ((*result.goals)[0].state, GoalState::reached);
  EXPECT_FALSE(result.notes.empty());
  EXPECT_EQ(refused("solve", R"({"method":"levers","goals":[]})").path, "/params/method");
}

TEST_F(Solve, ADeadlineEndsItWithTheBestPoseSoFar) {
  std::string goals;
  for (const char* at : {"right_hand", "left_hand", "head", "left_foot", "right_foot", "upper_torso", "left_upper_leg"})
    goals += std::string(goals.empty() ? "" : ",") + R"({"at":")" + at + R"(","position":[3,1,-2]},{"at":")" + at +
             R"(","position":[-3,2,4],"priority":1})";
  const auto result =
      solve(R"({"figure":{"template":"tempus","stature":1.75},"deadline_us":1,"goals":[)" + goals + "]}");
  EXPECT_EQ(result.status, SolveStatus::deadline);
  for (const double value : *result.q) EXPECT_TRUE(std::isfinite(value));
  EXPECT_EQ(refused("solve", R"({"deadline_us":0,"goals":[]})").path, "/params/deadline_us");
}

TEST_F(Solve, MistakesAreNamedWithTheirCure) {
  const std::tuple<const char*, const char*, const char*> mistakes[] = {
      {R"({"goals":[{"at":"right_hnd","position":[0,0,1]}]})", "unknown_segment", "/params/goals/0/at"},
      {R"({"goals":[{"at":"head","position":[0,0,1],"relative_to":{"figure":"other","segment":"head"}}]})",
       "invalid_params", "/params/goals/0/relative_to/figure"},
      {R"({"goals":[{"at":"head","position":[0,0,1],"relative_to":{"sensor":"liberty:1"}}]})", "invalid_params",
       "/params/goals/0/relative_to"},
      {R"({"goals":[{"id":"a","at":"head","position":[0,0,1]},{"id":"a","at":"head","position":[0,0,1]}]})", "bad_id",
       "/params/goals/1/id"},
      {R"({"figure":"bod","goals":[]})", "unknown_figure", "/params/figure"},
      {R"({"figure":{"template":"tempus","stature":9},"goals":[]})", "out_of_range", "/params/figure/stature"},
      {R"({"figure":{"format":"posed.figure/1","root":"a","segments":[]},"goals":[]})", "bad_figure",
       "/params/figure/segments"},
      {R"({"goals":[],"fields":["qq"]})", "invalid_params", "/params/fields/0"},
      {R"({"goals":[],"problems":[]})", "unknown_field", "/params/problems"},
      {R"({})", "missing_field", "/params/goals"},
  };
  for (const auto& [params, code, path] : mistakes) {
    const Error error = refused("solve", params);
    EXPECT_EQ(error.code, code) << params << error.message;
    EXPECT_EQ(error.path, path) << params << error.message;
  }
  std::string many = R"({"at":"head","position":[0,0,1]})";
  for (int i = 0; i < 200; ++i) many += R"(,{"at":"head","position":[0,0,1]})";
  EXPECT_EQ(refused("solve", R"({"goals":[)" + many + "]}").code, "too_large");
}

TEST_F(Solve, ABadProblemOfABatchSpoilsNoOther) {
  const auto text =
      client.call("solve.batch", R"({"figure":"body","start":"rest","pins":{},"fields":["goals"],"problems":[
      {"goals":[{"at":"right_hand","position":[0.4,-0.3,1.3]}]},
      {"goals":[{"at":"right_hnd","position":[0.4,-0.3,1.3]}]},
      {"goal":[]},
      {"figure":"nobody","goals":[]},
      {"figure":{"template":"tempus","stature":1.5},"start":"rest","goals":[{"at":"left_hand","position":[0.3,0.3,1.1]}]}]})");
  ASSERT_TRUE(text) << text.error().message;
  const auto answer = proto::decode_message<proto::SolveBatchResult>(*text);
  ASSERT_TRUE(answer && answer->results.size() == 5);
  for (const std::size_t good : {0u, 4u}) {
    ASSERT_FALSE(answer->results[good].error);
    EXPECT_EQ(answer->results[good].result.goals->at(0).state, GoalState::reached);
  }
  const char* paths[] = {"/params/problems/1/goals/0/at", "/params/problems/2/goals", "/params/problems/3/figure"};
  for (std::size_t bad = 1; bad <= 3; ++bad) {
    ASSERT_TRUE(answer->results[bad].error);
    EXPECT_EQ(answer->results[bad].error->path, paths[bad - 1]);
    EXPECT_FALSE(answer->results[bad].error->hint.empty());
  }
  EXPECT_EQ(*client.call("solve.batch", R"({"problems":[]})"), R"({"results":[]})");
}

TEST_F(Solve, ABatchAnswersInOrderWithProgressWhereItIsAskedFor) {
  client.set_timeout(std::chrono::minutes(5));
  std::vector<std::uint64_t> told;
  client.on_progress([&](std::uint64_t done, std::uint64_t of) {
    EXPECT_EQ(of, 3000u);
    told.push_back(done);
  });
  const auto begin = std::chrono::steady_clock::now();
  const auto text = client.call("solve.batch", batch(3000, R"(,"progress":true)"));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_GT(text->size(), std::size_t{5} << 20) << "larger than what may wait of ordinary replies";
  const Json results = Json::parse(*text).at("results");
  ASSERT_EQ(results.size(), 3000u);
  for (std::size_t i = 0; i < results.size(); i += 97) {
    EXPECT_NEAR(results[i].at("goals").at(0).at("target").at(0).get<double>(), 0.2 + 0.0001 * static_cast<double>(i),
                1e-6);
  }
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_LE(static_cast<double>(told.size()), 10.0 * seconds + 1.0);
  told.clear();
  ASSERT_TRUE(client.call("solve.batch", batch(300, "")));
  EXPECT_TRUE(told.empty());
}

TEST_F(Solve, TooManyProblemsAreRefused) {
  std::string text = R"({"problems":[{"goals":[]})";
  for (int i = 1; i < 10'001; ++i) text += R"(,{"goals":[]})";
  EXPECT_EQ(refused("solve.batch", text + "]}").code, "too_large");
}

TEST_F(Solve, AVanishedPeersWorkIsDropped) {
  {
    auto gone = daemon.connect();
    gone.set_timeout(std::chrono::milliseconds(300));
    std::string problems;
    for (int i = 0; i < 5000; ++i)
      problems += std::string(i > 0 ? "," : "") + R"({"goals":[{"at":"right_hand","position":[3,1,2]},{"at":"left_foot",
          "position":[-3,1,2]},{"at":"head","position":[0,0,-2]},{"at":"left_hand","position":[0,3,2]}]})";
    const auto text =
        gone.call("solve.batch", R"({"figure":{"template":"tempus"},"progress":true,"problems":[)" + problems + "]}");
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().code, "timeout");
  }
  // What others ask for meanwhile is not kept waiting, and the daemon goes on.
  const auto begin = std::chrono::steady_clock::now();
  solve(R"({"goals":[{"at":"right_hand","position":[0.4,-0.3,1.3]}]})");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  for (int i = 0; i < 600; ++i) {
    if (client.call<proto::StatusResult>(proto::SessionStatus{})->connections == 1) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  FAIL() << "the peer's connection is still there";
}

}  // namespace
}  // namespace posed
