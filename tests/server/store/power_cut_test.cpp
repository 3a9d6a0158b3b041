// What the store has answered survives a power cut at whatever moment, and what it has not is there whole or not at
// all.
#include "tests/support/power_cut.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>
#include <future>
#include <random>

#include "server/store/store.h"

namespace posed {
namespace {

namespace fs = std::filesystem;

class PowerCutTest : public ::testing::Test {
 protected:
  PowerCutTest() {
    std::string name = (fs::temp_directory_path() / "posed-power-XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  ~PowerCutTest() override { fs::remove_all(folder); }

  // The n-th state: three parts say the same number, so that a state that is torn shows.
  static StoredChanges state(std::uint64_t n) {
    StoredChanges changes;
    changes.revision = n;
    const std::string text = "{\"n\":" + std::to_string(n) + ",\"pad\":\"" + std::string(n * 37 % 3000, 'x') + "\"}";
    for (const char* path : {"/figures/body", "/figures/body/q", "/goals/g1"}) changes.set.push_back({path, n, text});
    if (n % 3 == 0)
      changes.removed.push_back("/goals/third");
    else
      changes.set.push_back({"/goals/third", n, text});
    changes.once.push_back({"uuid-" + std::to_string(n), "goal.set", std::to_string(n)});
    return changes;
  }

  static Status commit(Store& store, StoredChanges changes) {
    std::promise<Status> answer;
    store.commit(std::move(changes), [&](Status status) { answer.set_value(std::move(status)); });
    return answer.get_future().get();
  }

  static void expect_whole(const StoredScene& scene) {
    if (scene.revision == 0) return;
    const StoredChanges expected = state(scene.revision);
    ASSERT_EQ(scene.parts.size(), expected.set.size());
    for (const StoredPart& part : scene.parts) {
      EXPECT_EQ(part.revision, scene.revision) << part.path;
      EXPECT_EQ(part.document, expected.set[0].document) << part.path;
    }
    ASSERT_FALSE(scene.once.empty());
    EXPECT_EQ(scene.once.back().result, std::to_string(scene.revision));
  }

  fs::path folder;
};

TEST_F(PowerCutTest, WhatWasAnsweredSurvivesACutAtAnyMoment) {
  std::mt19937 random{7};
  for (unsigned seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    test::PowerCut power(seed);
    std::uint64_t answered = 0, asked = 0;
    {
      Store store(folder);
      expect_whole(store.live());
      answered = asked = store.live().revision;
      power.cut_after(1 + random() % 120);
      while (!power.cut()) {
        if (commit(store, state(++asked))) answered = asked;
      }
    }
    power.restart();
    const Store store(folder);
    EXPECT_GE(store.live().revision, answered);
    EXPECT_LE(store.live().revision, asked);
    expect_whole(store.live());
    if (HasFailure()) return;
  }
}

TEST_F(PowerCutTest, AFullDiskIsAnErrorAndNothingElse) {
  test::PowerCut power(1);
  Store store(folder);
  ASSERT_TRUE(commit(store, state(1)));
  power.full_after(2000);
  const Status full = commit(store, state(2));
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().code, "store_failed");
  EXPECT_NE(full.error().message.find("full"), std::string::npos) << full.error().message;
  ASSERT_FALSE(commit(store, state(3)));
  power.full_after(0);
  EXPECT_TRUE(commit(store, state(4))) << "there is room again";
}

// Where nobody waits for the disk what was answered is gone: this proves that the first test can fail.
TEST_F(PowerCutTest, TheDiskOfThisTestDoesLoseWhatIsNotSynced) {
  int lost = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const std::string file = (folder / (std::to_string(seed) + ".db")).string();
    test::PowerCut power(seed);
    const auto rows = [&file](const char* sql) {
      sqlite3* db = nullptr;
      EXPECT_EQ(sqlite3_open(file.c_str(), &db), SQLITE_OK);
      int count = 0;
      const auto each = [](void* n, int, char**, char**) { return ++*static_cast<int*>(n), 0; };
      EXPECT_EQ(sqlite3_exec(db, sql, each, &count, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
      return std::pair(db, count);
    };
    sqlite3_close(rows("CREATE TABLE t (n)").first);
    sqlite3* db = rows("PRAGMA journal_mode = WAL; PRAGMA synchronous = OFF; INSERT INTO t VALUES (1)").first;
    power.cut_after(0);
    sqlite3_close(db);
    power.restart();
    const auto [again, count] = rows("SELECT n FROM t");
    sqlite3_close(again);
    lost += count == 0;
  }
  EXPECT_GT(lost, 0);
}

}  // namespace
}  // namespace posed
