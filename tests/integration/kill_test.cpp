// The program, killed at any moment: what was acknowledged is there again, with the pose.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <random>
#include <regex>
#include <thread>

#include "running_daemon.h"

namespace posed {
namespace {

constexpr const char* kPosed = POSED_PROGRAMS "/posed";

class Program {
 public:
  Program(const std::filesystem::path& data, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {kPosed, "--listen", "127.0.0.1:0", "--data", data.string(), "--log", "error"};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("pipe");
    posix_spawn_file_actions_t wiring;
    posix_spawn_file_actions_init(&wiring);
    posix_spawn_file_actions_adddup2(&wiring, ends[1], 1);
    posix_spawn_file_actions_addclose(&wiring, ends[0]);
    const int failed = posix_spawn(&pid_, argv[0], &wiring, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&wiring);
    ::close(ends[1]);
    if (failed != 0) throw std::runtime_error("posix_spawn");
    FILE* out = fdopen(ends[0], "r");
    char line[512] = {};
    std::cmatch match;
    if (fgets(line, sizeof line, out) && std::regex_search(line, match, std::regex(":([0-9]+)/"))) port_ = match[1];
    fclose(out);
  }
  ~Program() { kill_now(); }

  void kill_now() {
    if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }
  client::Client connect() const {
    auto made = client::Client::connect("tcp://127.0.0.1:" + port_, std::chrono::seconds(60));
    if (!made) throw std::runtime_error("port " + port_ + ": " + made.error().message);
    return std::move(*made);
  }

 private:
  pid_t pid_ = 0;
  std::string port_;
};

int kills() {
  const char* many = std::getenv("POSED_KILLS");
  return many ? std::atoi(many) : 20;
}

TEST(Kill, WhatWasAcknowledgedIsThereAgain) {
  const test::TemporaryFolder data;
  std::mt19937 random{3};
  int acknowledged = 0, asked = 0;
  std::uint64_t revision = 0;
  for (int round = 0; round < kills(); ++round) {
    Program posed(data.path());
    auto client = posed.connect();
    if (acknowledged > 0) {
      const auto goal = client.call<proto::GoalResult>(proto::GoalGet{"g1"});
      ASSERT_TRUE(goal) << goal.error().message << " in round " << round;
      const Vec3* position = position_of(goal->goal.payload);
      ASSERT_NE(position, nullptr);
      const int found = static_cast<int>(std::lround(position->x * 1e4));
      EXPECT_GE(found, acknowledged) << "an acknowledged edit is lost";
      EXPECT_LE(found, asked);
      acknowledged = asked = found;
      EXPECT_GE(client.call<proto::StatusResult>(proto::SessionStatus{})->revision, revision);
    }
    // Killed from another thread, while edits are on their way.
    const auto moment = std::chrono::microseconds(2000 + random() % 150'000);
    std::thread killer([&] {
      std::this_thread::sleep_for(moment);
      posed.kill_now();
    });
    for (bool alive = true; alive;) {
      proto::GoalSet set;
      set.edit.id = "g1";
      set.edit.at = Attachment{"right_hand", {}, ""};
      set.edit.position = Vec3(1e-4 * ++asked, -0.3, 1.2);
      const auto edited = client.call<proto::EditResult>(set);
      alive = static_cast<bool>(edited);
      if (!alive) break;
      acknowledged = asked;
      revision = edited->revision;
    }
    killer.join();
  }
  EXPECT_GT(acknowledged, 0) << "it was always killed before the first reply";
}

TEST(Kill, ThePoseComesBackAsItStood) {
  const test::TemporaryFolder data;
  std::vector<double> before;
  {
    Program posed(data.path());
    auto client = posed.connect();
    const auto edited = client.call("goal.set", R"({"at":"right_hand","position":[0.4,-0.3,1.3],"weight":3})");
    ASSERT_TRUE(edited) << edited.error().message;
    const auto pose = client.call<proto::PoseResult>(proto::PoseGet{});
    ASSERT_TRUE(pose);
    before = pose->pose.q;
  }
  Program posed(data.path());
  auto client = posed.connect();
  const auto pose = client.call<proto::PoseResult>(proto::PoseGet{});
  ASSERT_TRUE(pose) << pose.error().message;
  ASSERT_EQ(pose->pose.q.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(pose->pose.q[i], before[i], 1e-4) << i;
}

TEST(Kill, ARetryAfterwardsIsHarmless) {
  const test::TemporaryFolder data;
  const std::string mirror = R"({"once":"0b6f2f4e-7c1d-4a53-9a56-3f1e2d4c5b6a"})";
  Result<std::string> first = std::string();
  {
    Program posed(data.path(), {"--scene.template", "empty"});
    first = posed.connect().call("pose.mirror", mirror);
    ASSERT_TRUE(first) << first.error().message;
  }
  Program posed(data.path());
  auto client = posed.connect();
  EXPECT_EQ(*client.call("pose.mirror", mirror), *first);
  const auto other = client.call("goal.clear", mirror);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().path, "/params/once");
}

TEST(Kill, TheCommandLineBeginsAnewAndADirectoryIsOneDaemons) {
  const test::TemporaryFolder data;
  {
    Program posed(data.path());
    ASSERT_TRUE(posed.connect().call("goal.set", R"({"id":"g1","at":"head","position":[0,0,1.6]})"));
    EXPECT_THROW(Program(data.path()).connect(), std::runtime_error);
  }
  {
    Program posed(data.path());
    EXPECT_TRUE(posed.connect().call("goal.get", R"({"id":"g1"})"));
  }
  Program posed(data.path(), {"--scene.template=empty"});
  EXPECT_FALSE(posed.connect().call("goal.get", R"({"id":"g1"})"));
}

}  // namespace
}  // namespace posed
