// Private to the store: SQLite with errors as values.
#pragma once

#include <sqlite3.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/result.h"
#include "server/store/store.h"

namespace posed {

class Database {
 public:
  explicit Database(const std::filesystem::path& file);  // throws std::runtime_error

  Status save(const std::string& name, const std::string& document);
  StoredScene live();  // throws
  Status commit(const StoredChanges& changes);
  Result<std::string> load(const std::string& name);
  Status remove(const std::string& name);
  Result<std::vector<std::string>> list();

 private:
  struct Closer {
    void operator()(sqlite3* db) const { sqlite3_close_v2(db); }
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Closer>;

  Statement prepare(const char* sql);
  Status run(const char* sql);
  Status write(const StoredChanges& changes);
  void check();             // throws
  void migrate(int found);  // throws
  Error failure(const char* doing) const;
  int number(const char* sql);    // throws
  void execute(const char* sql);  // throws
  [[noreturn]] void refuse(const std::string& why) const;

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Closer> db_;
};

}  // namespace posed
