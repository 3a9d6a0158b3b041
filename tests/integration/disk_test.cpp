// The whole daemon over a disk that is full for a while, and over files of other formats.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "running_daemon.h"
#include "tests/support/power_cut.h"

namespace posed {
namespace {

using nlohmann::json;

constexpr const char* kReach = R"({"id":"g1","at":"right_hand","position":[0.4,-0.3,1.2]})";

json document_of(client::Client& client) {
  json document = json::parse(client.call("scene.get").value())["document"];
  for (auto& [id, figure] : document["figures"].items()) figure.erase("q");  // which is on its way
  return document;
}

TEST(Disk, WhereItIsFullEditsAreRefusedAndTheDaemonLivesOn) {
  const test::TemporaryFolder data;
  test::PowerCut disk(1);
  json at_the_end;
  {
    const test::RunningDaemon daemon({}, "standing", data.path());
    auto ana = daemon.connect(), ben = daemon.connect();
    ASSERT_TRUE(ben.subscribe({proto::Stream::scene, {}, {}, 0.0, 0}));
    json copy = json::parse(ben.next(std::chrono::seconds(60))->data);
    ASSERT_TRUE(ana.call("goal.set", kReach));
    const json before = document_of(ana);
    const auto revision = [](client::Client& client) {
      return client.call<proto::StatusResult>(proto::SessionStatus{})->revision;
    };
    std::uint64_t last = revision(ana);

    disk.full_after(1);
    const std::string once = R"("once":"0b6f2f4e-7c1d-4a53-9a56-3f1e2d4c5b6a")";
    for (const std::string params :
         {R"({"id":"g2","at":"head","position":[0,0,1.6]})", R"({"id":"g1","weight":40,"gesture":"slide"})"}) {
      const auto refused = ana.call("goal.set", params);
      ASSERT_FALSE(refused) << params;
      EXPECT_EQ(refused.error().code, "store_failed");
      EXPECT_NE(refused.error().message.find("full"), std::string::npos) << refused.error().message;
      EXPECT_FALSE(refused.error().hint.empty());
    }
    EXPECT_EQ(ana.call("edit.undo", "{}").error().code, "store_failed");
    EXPECT_EQ(ana.call("goal.remove", R"({"id":"g1",)" + once + "}").error().code, "store_failed");
    EXPECT_EQ(ana.call("scene.save", R"({"name":"monday"})").error().code, "store_failed");
    EXPECT_EQ(document_of(ana), before) << "what was refused has not happened";
    EXPECT_TRUE(ben.call("pose.get")) << "and the others do not notice";
    EXPECT_GE(revision(ben), last);
    last = revision(ben);

    disk.full_after(0);
    ASSERT_TRUE(ana.call("goal.set", R"({"id":"g2","at":"head","position":[0,0,1.6]})"));
    EXPECT_GT(revision(ana), last);
    ASSERT_TRUE(ana.call("edit.undo", "{}"));
    EXPECT_EQ(document_of(ana), before);
    ASSERT_TRUE(ana.call("edit.undo", "{}")) << "the edit from before the disk was full is still to be undone";
    EXPECT_EQ(json::parse(*ana.call("goal.list"))["goals"].size(), before["goals"].size() - 1);
    ASSERT_TRUE(ana.call("edit.redo", "{}"));
    // The retry of what was refused is done now.
    ASSERT_TRUE(ana.call("goal.remove", R"({"id":"g1",)" + once + "}"));
    ASSERT_TRUE(ana.call("scene.save", R"({"name":"monday"})"));
    at_the_end = document_of(ana);

    // Who followed all along has the same.
    last = revision(ana);
    while (copy["revision"] < last) {
      const auto frame = ben.next(std::chrono::seconds(60));
      ASSERT_TRUE(frame) << frame.error().message;
      const json change = json::parse(frame->data);
      ASSERT_EQ(change["from_revision"], copy["revision"]);
      copy["document"] = copy["document"].patch(change["patch"]);
      copy["revision"] = change["revision"];
    }
    EXPECT_EQ(copy["document"], at_the_end);
  }
  const test::RunningDaemon daemon({}, "standing", data.path());
  auto client = daemon.connect();
  EXPECT_EQ(document_of(client), at_the_end);
  EXPECT_TRUE(client.call("scene.open", R"({"name":"monday"})"));
}

TEST(Disk, ScenesOfTheFirstFormatAreOpened) {
  const test::TemporaryFolder data;
  {
    std::ifstream in(POSED_SOURCE_DIR "/tests/golden/store/version-1.sql");
    const std::string old{std::istreambuf_iterator<char>(in), {}};
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open((data.path() / "posed.db").c_str(), &db), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(db, old.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
    sqlite3_close(db);
  }
  const test::RunningDaemon daemon({}, "standing", data.path());
  auto client = daemon.connect();
  const auto opened = client.call("scene.open", R"({"name":"monday"})");
  ASSERT_TRUE(opened) << opened.error().path << opened.error().message;
  EXPECT_TRUE(document_of(client)["goals"].contains("reach"));
  ASSERT_TRUE(client.call("scene.remove", R"({"name":"monday"})"));
  EXPECT_EQ(json::parse(*client.call("scene.list"))["saved"], json({"empty"}));
  const auto gone = client.call("scene.remove", R"({"name":"monday"})");
  EXPECT_EQ(gone.error().code, "unknown_scene");
  EXPECT_EQ(gone.error().path, "/params/name");
}

TEST(Disk, FilesThatAreNotOursToReadAreRefusedWithTheCure) {
  const test::TemporaryFolder data;
  const auto why_not = [&]() -> std::string {
    try {
      const test::RunningDaemon daemon({}, "standing", data.path());
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "it started";
  };
  const auto put = [&](const std::string& text) { std::ofstream(data.path() / "posed.db") << text; };
  put(std::string(8192, 'x'));
  EXPECT_NE(why_not().find("is not a posed database"), std::string::npos) << why_not();
  std::filesystem::remove(data.path() / "posed.db");
  { const test::RunningDaemon daemon({}, "standing", data.path()); }
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open((data.path() / "posed.db").c_str(), &db), SQLITE_OK);
  sqlite3_exec(db, "PRAGMA user_version = 99", nullptr, nullptr, nullptr);
  sqlite3_close(db);
  EXPECT_NE(why_not().find("newer posed"), std::string::npos) << why_not();
  EXPECT_NE(why_not().find("--data"), std::string::npos) << why_not();
}

}  // namespace
}  // namespace posed
