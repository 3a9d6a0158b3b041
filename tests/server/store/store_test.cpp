#include "server/store/store.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>
#include <future>
#include <iterator>

namespace posed {
namespace {

namespace fs = std::filesystem;

// What the store answers on its thread, waited for.
template <class T, class F>
Result<T> answer(F ask) {
  std::promise<Result<T>> promise;
  ask([&](Result<T> result) { promise.set_value(std::move(result)); });
  return promise.get_future().get();
}
Status save(Store& store, const std::string& name, const std::string& document) {
  return answer<Ok>([&](auto done) { store.save(name, document, done); });
}
Result<std::string> load(Store& store, const std::string& name) {
  return answer<std::string>([&](auto done) { store.load(name, done); });
}
std::vector<std::string> list(Store& store) {
  return *answer<std::vector<std::string>>([&](auto done) { store.list(done); });
}

class StoreTest : public ::testing::Test {
 protected:
  StoreTest() {
    std::string name = (fs::temp_directory_path() / "posed-store-XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  ~StoreTest() override { fs::remove_all(folder); }

  std::string bytes(const fs::path& file) const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string why_not(const fs::path& directory) const {
    try {
      const Store store(directory);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "it was opened";
  }
  void sql(const char* text) const {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open((folder / "posed.db").c_str(), &db), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(db, text, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
    sqlite3_close(db);
  }

  fs::path folder;
};

TEST_F(StoreTest, WhatIsSavedComesBack) {
  const std::string document = "{\"format\":\"posed.scene/1\",\"label\":\"\xc3\xbc '; DROP TABLE scene; --\"}";
  {
    Store store(folder);
    EXPECT_TRUE(list(store).empty());
    ASSERT_TRUE(save(store, "monday", document));
    EXPECT_EQ(*load(store, "monday"), document);
  }
  Store again(folder);
  EXPECT_EQ(*load(again, "monday"), document);
  EXPECT_EQ(list(again), (std::vector<std::string>{"monday"}));
}

TEST_F(StoreTest, SavingAgainReplaces) {
  Store store(folder);
  ASSERT_TRUE(save(store, "monday", "one"));
  ASSERT_TRUE(save(store, "monday", "two"));
  EXPECT_EQ(*load(store, "monday"), "two");
  EXPECT_EQ(list(store).size(), 1u);
}

TEST_F(StoreTest, ListIsSorted) {
  Store store(folder);
  for (const char* name : {"b", "a", "C", "a.1"}) ASSERT_TRUE(save(store, name, name));
  EXPECT_EQ(list(store), (std::vector<std::string>{"C", "a", "a.1", "b"}));
}

TEST_F(StoreTest, TheUnknownIsToldByName) {
  Store store(folder);
  const Result<std::string> missing = load(store, "tuesday");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, "unknown_scene");
  EXPECT_EQ(missing.error().path, "/name");
  EXPECT_NE(missing.error().message.find("tuesday"), std::string::npos);
}

TEST_F(StoreTest, ABigDocumentAndAnEmptyOne) {
  Store store(folder);
  const std::string big(3'000'000, 'x');
  ASSERT_TRUE(save(store, "big", big));
  ASSERT_TRUE(save(store, "empty", ""));
  EXPECT_EQ(*load(store, "big"), big);
  EXPECT_EQ(*load(store, "empty"), "");
}

TEST_F(StoreTest, FinishesWhatWasAskedForBeforeItGoes) {
  int saved = 0;
  {
    Store store(folder);
    for (int i = 0; i < 20; ++i) {
      store.save("s" + std::to_string(i), "x", [&](const Status& status) { saved += status ? 1 : 0; });
    }
  }
  EXPECT_EQ(saved, 20);
  Store again(folder);
  EXPECT_EQ(list(again).size(), 20u);
}

TEST_F(StoreTest, MakesItsDirectory) {
  Store store(folder / "deep" / "er");
  EXPECT_TRUE(save(store, "a", "b"));
  EXPECT_TRUE(fs::exists(folder / "deep" / "er" / "posed.db"));
}

TEST_F(StoreTest, ADirectoryThatCannotBeMadeIsToldWithTheCure) {
  std::ofstream(folder / "file") << "in the way";
  const std::string why = why_not(folder / "file" / "data");
  EXPECT_NE(why.find("cannot make the data directory"), std::string::npos) << why;
  EXPECT_NE(why.find("--data"), std::string::npos) << why;
}

TEST_F(StoreTest, AFileThatIsNoDatabaseIsRefusedAndUntouched) {
  for (const std::string& text : {std::string("hello\n"), std::string(5000, 'x')}) {
    std::ofstream(folder / "posed.db", std::ios::trunc) << text;
    const std::string why = why_not(folder);
    EXPECT_NE(why.find("is not a posed database"), std::string::npos) << why;
    EXPECT_EQ(bytes(folder / "posed.db"), text);
  }
}

TEST_F(StoreTest, AnotherProgramsDatabaseIsRefusedAndUntouched) {
  sql("CREATE TABLE address (name TEXT); INSERT INTO address VALUES ('Ana')");
  const std::string before = bytes(folder / "posed.db");
  const std::string why = why_not(folder);
  EXPECT_NE(why.find("is not a posed database"), std::string::npos) << why;
  EXPECT_TRUE(bytes(folder / "posed.db") == before);
}

TEST_F(StoreTest, ANewerFormatIsRefusedAndUntouched) {
  {
    Store store(folder);
    ASSERT_TRUE(save(store, "monday", "document"));
  }
  sql("PRAGMA user_version = 3");
  const std::string before = bytes(folder / "posed.db");
  const std::string why = why_not(folder);
  EXPECT_NE(why.find("newer posed"), std::string::npos) << why;
  EXPECT_NE(why.find("--data"), std::string::npos) << why;
  EXPECT_TRUE(bytes(folder / "posed.db") == before);
  sql("PRAGMA user_version = 2");
  Store again(folder);
  EXPECT_EQ(*load(again, "monday"), "document");
}

// It was taken for another program's.
TEST_F(StoreTest, TheFirstFormatIsCarriedOver) {
  std::ifstream in(POSED_SOURCE_DIR "/tests/golden/store/version-1.sql");
  const std::string old{std::istreambuf_iterator<char>(in), {}};
  ASSERT_FALSE(old.empty());
  sql(old.c_str());
  std::string monday;
  {
    Store store(folder);
    EXPECT_EQ(list(store), (std::vector<std::string>{"empty", "monday"}));
    monday = *load(store, "monday");
    EXPECT_TRUE(monday.starts_with(R"({"format":"posed.scene/1")")) << monday;
    EXPECT_EQ(store.live().revision, 0u) << "it had no live scene";
    StoredChanges changes;
    changes.revision = 7;
    changes.set.push_back({"/goals/g1", 3, "{}"});
    ASSERT_TRUE(answer<Ok>([&](auto done) { store.commit(changes, done); }));
  }
  Store again(folder);
  EXPECT_EQ(*load(again, "monday"), monday);
  EXPECT_EQ(again.live().revision, 7u);
}

TEST_F(StoreTest, AFileThatSaysOurFormatAndHasNoneOfItIsRefusedAndUntouched) {
  sql("CREATE TABLE address (name TEXT); PRAGMA user_version = 2");
  const std::string before = bytes(folder / "posed.db");
  EXPECT_NE(why_not(folder).find("is not a posed database"), std::string::npos) << why_not(folder);
  EXPECT_TRUE(bytes(folder / "posed.db") == before);
}

TEST_F(StoreTest, ADamagedFileIsRefusedAndUntouched) {
  {
    Store store(folder);
    for (int i = 0; i < 50; ++i) ASSERT_TRUE(save(store, "scene" + std::to_string(i), std::string(3000, 'x')));
  }
  const std::string good = bytes(folder / "posed.db");
  ASSERT_GT(good.size(), 100'000u);
  for (const std::size_t at : {good.size() / 2, std::size_t{4096}}) {
    std::string damaged = good;
    damaged.replace(at, 4096, std::string(4096, '\x5a'));
    std::ofstream(folder / "posed.db", std::ios::binary | std::ios::trunc) << damaged;
    const std::string why = why_not(folder);
    EXPECT_NE(why.find("left as it is"), std::string::npos) << why;
    EXPECT_NE(why.find("--data"), std::string::npos) << why;
    EXPECT_TRUE(bytes(folder / "posed.db") == damaged);
  }
}

TEST_F(StoreTest, WhatIsRemovedIsGone) {
  Store store(folder);
  ASSERT_TRUE(save(store, "monday", "document"));
  const auto remove = [&] { return answer<Ok>([&](auto done) { store.remove("monday", done); }); };
  ASSERT_TRUE(remove());
  EXPECT_TRUE(list(store).empty());
  const auto again = remove();
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, "unknown_scene");
  EXPECT_EQ(again.error().path, "/name");
}

TEST_F(StoreTest, ADiskThatFailsIsAnError) {
  Store store(folder);
  ASSERT_TRUE(save(store, "monday", "document"));
  sql("DROP TABLE scene");
  EXPECT_EQ(save(store, "monday", "document").error().code, "store_failed");
  EXPECT_EQ(load(store, "monday").error().code, "store_failed");
}

}  // namespace
}  // namespace posed
