// The program as a user starts it: what it prints, how it ends.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <regex>
#include <string>
#include <vector>

#include "running_daemon.h"

namespace posed {
namespace {

constexpr const char* kPosed = POSED_PROGRAMS "/posed";

// A child whose standard output and error come through one pipe.
class Child {
 public:
  explicit Child(std::vector<std::string> arguments) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("pipe");
    std::vector<char*> argv;
    for (auto& a : arguments) argv.push_back(a.data());
    argv.push_back(nullptr);
    // Not fork: the test's own threads may hold the allocator's lock just then, and the child would wait for ever.
    posix_spawn_file_actions_t wiring;
    posix_spawn_file_actions_init(&wiring);
    posix_spawn_file_actions_adddup2(&wiring, ends[1], 1);
    posix_spawn_file_actions_adddup2(&wiring, ends[1], 2);
    posix_spawn_file_actions_addclose(&wiring, ends[0]);
    const int failed = posix_spawn(&pid_, argv[0], &wiring, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&wiring);
    close(ends[1]);
    if (failed != 0) throw std::runtime_error("posix_spawn");
    out_ = fdopen(ends[0], "r");
  }
  ~Child() {
    if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
    fclose(out_);
  }
  std::string line() {
    char text[4096];
    return fgets(text, sizeof text, out_) ? text : "";
  }
  std::string rest() {
    std::string all;
    for (std::string l = line(); !l.empty(); l = line()) all += l;
    return all;
  }
  int wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  void terminate() const { kill(pid_, SIGTERM); }

 private:
  pid_t pid_ = 0;
  FILE* out_ = nullptr;
};

struct Ended {
  int code;
  std::string text;
};

Ended run(std::vector<std::string> arguments) {
  Child child(std::move(arguments));
  std::string text = child.rest();
  return {child.wait(), std::move(text)};
}

TEST(Program, PrintsTheViewersAddressAndStopsCleanlyOnSigterm) {
  const test::TemporaryFolder data;
  Child posed({kPosed, "--listen", "127.0.0.1:0", "--tracker", "simulated", "--data", data.path()});
  const std::string first = posed.line();
  std::smatch match;
  ASSERT_TRUE(std::regex_search(first, match, std::regex("http://127\\.0\\.0\\.1:([0-9]+)/"))) << first;
  auto client = client::Client::connect("tcp://127.0.0.1:" + match[1].str(), std::chrono::seconds(60));
  ASSERT_TRUE(client) << client.error().message;
  ASSERT_TRUE(client->subscribe({proto::Stream::tracker, {}, {}, 0.0, 0}));
  ASSERT_TRUE(client->next(std::chrono::seconds(60)));
  posed.terminate();
  EXPECT_NE(posed.rest().find("stopped"), std::string::npos);
  EXPECT_EQ(posed.wait(), 0);
}

TEST(Program, APortInUseIsOneClearLine) {
  const test::RunningDaemon daemon;
  const test::TemporaryFolder data;
  const Ended ended = run({kPosed, "--listen", "127.0.0.1:" + std::to_string(daemon.port()), "--data", data.path()});
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.text.find("in use"), std::string::npos) << ended.text;
  EXPECT_NE(ended.text.find("--listen"), std::string::npos) << ended.text;
  EXPECT_EQ(std::count(ended.text.begin(), ended.text.end(), '\n'), 1) << ended.text;
}

TEST(Program, MistakesOnTheCommandLineAreOneClearLine) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{"--lisen", "127.0.0.1:1"}, "--lisen"},
      {{"--listen", "nonsense"}, "HOST:PORT"},
      {{"--listen", "0.0.0.0:0"}, "--listen.open"},
      {{"--listen", "0.0.0.0:0"}, "--tls.certificate"},
      {{"--listen", "0.0.0.0:0", "--auth.tokens", "tokens"}, "--listen.open"},
      {{"--listen", "[::]:0", "--tls.certificate", "c", "--tls.key", "k"}, "--auth.tokens"},
      {{"--tls.certificate", "c"}, "--tls.key"},
      {{"--log", "loud"}, "loud"},
      {{"--config", "/nonexistent/posed.conf"}, "posed.conf"},
  };
  for (const auto& [arguments, word] : mistakes) {
    std::vector<std::string> all = {kPosed};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Ended ended = run(all);
    EXPECT_EQ(ended.code, 2) << ended.text;
    EXPECT_NE(ended.text.find(word), std::string::npos) << ended.text;
    EXPECT_EQ(std::count(ended.text.begin(), ended.text.end(), '\n'), 1) << ended.text;
  }
}

TEST(Program, WhatIsWrongAtTheStartIsOneClearLine) {
  const test::TemporaryFolder data;
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{"--tracker", "wand"}, "wand"},
      {{"--tracker", "isotrak"}, "isotrak"},
      {{"--tracker", "a=simulated", "--tracker", "a=simulated"}, "two trackers"},
      {{"--tracker", "a b=simulated"}, "is no name"},
      {{"--scene.template", "paper/siting"}, "paper/sitting"},
      {{"--data", "/proc/nothing/here"}, "--data"},
  };
  for (const auto& [arguments, word] : mistakes) {
    std::vector<std::string> all = {kPosed, "--listen", "127.0.0.1:0"};
    if (arguments[0] != "--data") all.insert(all.end(), {"--data", data.path()});
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Ended ended = run(all);
    EXPECT_EQ(ended.code, 1) << ended.text;
    EXPECT_NE(ended.text.find(word), std::string::npos) << ended.text;
    EXPECT_EQ(std::count(ended.text.begin(), ended.text.end(), '\n'), 1) << ended.text;
  }
}

TEST(Program, AConfigurationFileSaysTheSameAsOptions) {
  const test::TemporaryFolder data;
  const std::string file = data.path() / "posed.conf";
  FILE* out = fopen(file.c_str(), "w");
  fprintf(out,
          "# a comment\nlisten = \"127.0.0.1:0\"\ntracker = [\"simulated\"]\nscene.template = \"paper/sitting\"\ndata "
          "= \"%s\"\n",
          data.path().c_str());
  fclose(out);
  Child posed({kPosed, "--config", file});
  const std::string first = posed.line();
  std::smatch match;
  ASSERT_TRUE(std::regex_search(first, match, std::regex(":([0-9]+)/"))) << first;
  auto client = client::Client::connect("tcp://127.0.0.1:" + match[1].str(), std::chrono::seconds(60));
  ASSERT_TRUE(client) << client.error().message;
  const auto status = client->call<proto::StatusResult>(proto::SessionStatus{});
  ASSERT_TRUE(status);
  EXPECT_EQ(status->goals, 4);
  EXPECT_EQ(status->trackers, 1);
  posed.terminate();
  EXPECT_EQ(posed.wait(), 0);
}

TEST(Program, VersionAndHelp) {
  EXPECT_EQ(run({kPosed, "--version"}).text.substr(0, 6), "posed ");
  EXPECT_EQ(run({kPosed, "--help"}).code, 0);
}

}  // namespace
}  // namespace posed
