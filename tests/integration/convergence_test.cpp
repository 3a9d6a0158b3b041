// Two clients edit the same entities, in turn and at once, and lose their connections meanwhile; a third comes and
// goes. Whoever follows the scene stream has the same document at the same revision, and ends with the daemon's, byte
// for byte.
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "running_daemon.h"

namespace posed {
namespace {

using nlohmann::json;

// Of both together; fewer where a sanitizer looks on.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr int kEdits = 1'600;
#else
constexpr int kEdits = 10'000;
#endif
constexpr const char* kArm =
    R"({"id":"arm","document":{"format":"posed.figure/1","root":"base","segments":[
      {"name":"base","touch_point":[0,0,0.1],"joint":{"name":"j0","type":"fixed","position":[0,0,0]}},
      {"name":"tip","parent":"base","touch_point":[0,0,0.5],"joint":{"name":"j1","type":"ball","position":[0,0,0.2]}}]}})";

// What a follower of the scene stream has, and a watch that all have the same.
class Copy {
 public:
  // A follower's copy begins anew with its next frame.
  void forget() { revision_ = 0; }
  void take(const std::string& text) {
    const json data = json::parse(text);
    if (data.contains("document")) {
      document_ = data["document"];
    } else {
      ASSERT_EQ(data["from_revision"], revision_) << "a change is missing";
      document_ = document_.patch(data["patch"]);
    }
    revision_ = data["revision"];
    static std::mutex mutex;
    static std::map<std::uint64_t, std::string> seen;
    const std::lock_guard lock(mutex);
    const auto [known, is_new] = seen.try_emplace(revision_, document_.dump());
    ASSERT_EQ(known->second, document_.dump()) << "another follower has another document at revision " << revision_;
  }
  std::uint64_t revision() const { return revision_; }
  std::string text() const { return document_.dump(); }

 private:
  json document_;
  std::uint64_t revision_ = 0;
};

class Editor {
 public:
  Editor(const test::RunningDaemon& daemon, std::string user, unsigned seed)
      : daemon_(daemon), user_(std::move(user)), random_(seed), client_(daemon.connect()) {
    connect();
  }

  void edit() {
    if (pick(200) == 0) return reconnect();
    const std::string goal = "g" + std::to_string(pick(6)), object = "o" + std::to_string(pick(2));
    json params{{"id", goal}};
    std::string method = "goal.set";
    switch (pick(12)) {
      case 0:
        method = "goal.remove";
        break;
      case 1:
        method = "object.set";
        params = {{"id", object}, {"position", {0.1 * pick(9), 0, 0}}};
        break;
      case 2:
        method = "object.remove";
        params = {{"id", object}};
        break;
      case 3:
      case 4:
        method = "edit.undo";
        params = json::object();
        break;
      case 5:
        method = "edit.redo";
        params = json::object();
        break;
      case 6:
        method = "edit.apply";
        params = {
            {"edits",
             {{{"method", "object.set"}, {"params", {{"id", object}, {"label", std::to_string(pick(9))}}}},
              {{"method", "goal.set"},
               {"params",
                {{"id", goal}, {"at", "tip"}, {"relative_to", {{"object", object}}}, {"position", {0, 0, 0.5}}}}}}}};
        break;
      case 7:
        method = "figure.pin";
        params = {{"figure", "arm"}, {"segment", "tip"}, {"hold", nullptr}};
        if (pick(2)) params["hold"] = "orientation";
        break;
      case 8:
        params.update({{"at", "tip"}, {"position", {0, 0, 0.1 * pick(9)}}, {"if_revision", pick(20)}});
        break;
      default:
        params.update({{"at", pick(2) ? "tip" : "base"}, {"position", {0, 0.1 * pick(9), 0.3}}, {"weight", pick(20)}});
        if (pick(2)) params["gesture"] = "drag-" + std::to_string(pick(3));
    }
    const bool once = pick(10) == 0;
    if (once) params["once"] = uuid();
    const auto reply = client_.call(method, params.dump());
    if (reply) ++accepted;
    // A retry, as if the reply had been lost: on a connection of its own, sometimes.
    if (once && reply) {
      if (pick(3) == 0) reconnect();
      EXPECT_EQ(client_.call(method, params.dump()).value(), *reply) << method;
    }
    if (!reply) ++refused[reply.error().code];
    follow(false, 0);
  }

  // Until that revision, where `to_the_end`; else what has come so far.
  void follow(bool to_the_end, std::uint64_t revision) {
    while (!to_the_end || copy_.revision() < revision) {
      const auto frame = client_.next(std::chrono::milliseconds(to_the_end ? 60'000 : 0));
      if (!frame) {
        ASSERT_FALSE(to_the_end) << frame.error().message;
        return;
      }
      copy_.take(frame->data);
    }
  }

  std::string document() const { return copy_.text(); }

  int accepted = 0;
  std::map<std::string, int> refused;

 private:
  int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  std::string uuid() {
    char text[40];
    std::snprintf(text, sizeof text, "%08x-%04x-4000-8000-%012x", static_cast<unsigned>(random_()),
                  static_cast<unsigned>(random_() & 0xffff), static_cast<unsigned>(random_()));
    return text;
  }
  void reconnect() {
    client_ = daemon_.connect();
    connect();
  }
  void connect() {
    json hello{{"user", user_}};
    if (!resume_.empty()) hello["resume"] = resume_;
    const auto reply = client_.call("session.hello", hello.dump());
    ASSERT_TRUE(reply) << reply.error().message;
    resume_ = json::parse(*reply)["resume"];
    ASSERT_TRUE(client_.subscribe({proto::Stream::scene, {}, {}, 0.0, 0}));
    copy_.forget();
  }

  const test::RunningDaemon& daemon_;
  const std::string user_;
  std::mt19937 random_;
  client::Client client_;
  std::string resume_;
  Copy copy_;
};

// Follows for a while, and leaves in one way or another.
int come_and_go(const test::RunningDaemon& daemon, const std::atomic<bool>& over) {
  std::mt19937 random{3};
  client::Client client = daemon.connect();
  Copy copy;
  int snapshots = 0;
  while (!over) {
    switch (random() % 4) {
      case 0:
        client = daemon.connect();
        copy.forget();
        break;
      case 1:
        EXPECT_TRUE(client.unsubscribe(proto::Stream::scene));
        break;
      case 2:
        EXPECT_TRUE(client.call("session.ping", "{}"));
        break;
      default:  // asks again while it follows
        break;
    }
    EXPECT_TRUE(client.subscribe({proto::Stream::scene, {}, {}, 0.0, 0}));
    for (auto frames = random() % 40; frames > 0 && !over; --frames) {
      const auto frame = client.next(std::chrono::milliseconds(50));
      if (!frame) continue;
      snapshots += json::parse(frame->data).contains("document");
      copy.take(frame->data);
      if (::testing::Test::HasFatalFailure()) return snapshots;
    }
  }
  return snapshots;
}

TEST(Convergence, AllWhoFollowHaveTheDaemonsDocument) {
  const test::RunningDaemon daemon({}, "empty");
  auto judge = daemon.connect();
  ASSERT_TRUE(judge.call("scene.new", R"({"template":"empty"})"));
  ASSERT_TRUE(judge.call("figure.set", kArm));
  ASSERT_TRUE(judge.call("figure.remove", R"({"id":"body"})"));
  Editor ana(daemon, "ana", 1), ben(daemon, "ben", 2);
  std::atomic<bool> over = false;
  int snapshots = 0;
  std::thread third([&] { snapshots = come_and_go(daemon, over); });
  for (int i = 0; i < kEdits / 8; ++i) {  // in turn
    ana.edit();
    ben.edit();
  }
  std::thread other([&] {
    for (int i = 0; i < kEdits * 3 / 8; ++i) ben.edit();
  });
  for (int i = 0; i < kEdits * 3 / 8; ++i) ana.edit();
  other.join();
  over = true;
  third.join();
  EXPECT_GT(snapshots, 10) << "the third was to come and go";
  const auto scene = judge.call("scene.get");
  ASSERT_TRUE(scene);
  json document = json::parse(*scene)["document"];
  const std::uint64_t revision = json::parse(*scene)["revision"];
  for (auto& [id, figure] : document["figures"].items()) figure.erase("q");  // the pose stream carries it
  for (Editor* editor : {&ana, &ben}) {
    editor->follow(true, revision);
    EXPECT_EQ(editor->document(), document.dump());
    EXPECT_GT(editor->accepted, kEdits / 5) << "most of it was to be done, not refused";
    for (const char* code : {"undo_conflict", "revision_mismatch", "unknown_goal"})
      EXPECT_GT(editor->refused[code], 0) << code << " has not been tried";
    for (const auto& [code, count] : editor->refused) EXPECT_NE(code, "internal");
  }
}

}  // namespace
}  // namespace posed
