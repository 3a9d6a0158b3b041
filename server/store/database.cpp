#include "server/store/database.h"

#include <stdexcept>

namespace posed {
namespace {
constexpr int kSchema = 1;
}

Database::Database(const std::filesystem::path& file) : file_(file) {
  sqlite3* db = nullptr;
  const int opened =
      sqlite3_open_v2(file.c_str(), &db, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
  db_.reset(db);
  if (opened != SQLITE_OK) {
    throw std::runtime_error("cannot open " + file.string() + ": " + sqlite3_errmsg(db) +
                             "; choose another directory with --data");
  }
  sqlite3_busy_timeout(db, 2000);
  const int found = number("PRAGMA user_version");
  if (found > kSchema) {
    throw std::runtime_error(file.string() + " was written by a newer posed (format " + std::to_string(found) +
                             "); it is left as it is: update posed, or choose another directory with --data");
  }
  if (found < kSchema && number("SELECT count(*) FROM sqlite_master") > 0) refuse("another program made it");
  execute("PRAGMA journal_mode = WAL");
  execute("PRAGMA synchronous = FULL");
  if (found == kSchema) return;
  execute("BEGIN IMMEDIATE");
  execute("CREATE TABLE IF NOT EXISTS scene (name TEXT PRIMARY KEY, document TEXT NOT NULL) WITHOUT ROWID");
  execute(("PRAGMA user_version = " + std::to_string(kSchema)).c_str());
  execute("COMMIT");
}

int Database::number(const char* sql) {
  const Statement statement = prepare(sql);
  if (!statement || sqlite3_step(statement.get()) != SQLITE_ROW) refuse(sqlite3_errmsg(db_.get()));
  return sqlite3_column_int(statement.get(), 0);
}

void Database::refuse(const std::string& why) const {
  throw std::runtime_error(file_.string() + " is not a posed database (" + why +
                           "); it is left as it is: move it away, or choose another directory with --data");
}

void Database::execute(const char* sql) {
  if (sqlite3_exec(db_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
    throw std::runtime_error("cannot write " + file_.string() + ": " + sqlite3_errmsg(db_.get()) +
                             "; choose another directory with --data");
  }
}

Database::Statement Database::prepare(const char* sql) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(db_.get(), sql, -1, &statement, nullptr);
  return Statement(statement);
}

Error Database::failure(const char* doing) const {
  return {"store_failed", std::string(doing) + " failed: " + sqlite3_errmsg(db_.get()), "",
          "is the disk full? see the daemon's log"};
}

Status Database::save(const std::string& name, const std::string& document) {
  const Statement statement =
      prepare("INSERT INTO scene VALUES (?1, ?2) ON CONFLICT (name) DO UPDATE SET document = ?2");
  if (!statement) return failure("saving");
  sqlite3_bind_text(statement.get(), 1, name.data(), static_cast<int>(name.size()), SQLITE_STATIC);
  sqlite3_bind_text(statement.get(), 2, document.data(), static_cast<int>(document.size()), SQLITE_STATIC);
  if (sqlite3_step(statement.get()) != SQLITE_DONE) return failure("saving");
  return Ok{};
}

Result<std::string> Database::load(const std::string& name) {
  const Statement statement = prepare("SELECT document FROM scene WHERE name = ?1");
  if (!statement) return failure("reading");
  sqlite3_bind_text(statement.get(), 1, name.data(), static_cast<int>(name.size()), SQLITE_STATIC);
  const int step = sqlite3_step(statement.get());
  if (step == SQLITE_DONE)
    return Error{"unknown_scene", "no scene was saved as " + name, "/name", "scene.list names them"};
  if (step != SQLITE_ROW) return failure("reading");
  return std::string(reinterpret_cast<const char*>(sqlite3_column_text(statement.get(), 0)),
                     static_cast<std::size_t>(sqlite3_column_bytes(statement.get(), 0)));
}

Result<std::vector<std::string>> Database::list() {
  const Statement statement = prepare("SELECT name FROM scene ORDER BY name");
  if (!statement) return failure("reading");
  std::vector<std::string> names;
  int step = sqlite3_step(statement.get());
  for (; step == SQLITE_ROW; step = sqlite3_step(statement.get())) {
    names.emplace_back(reinterpret_cast<const char*>(sqlite3_column_text(statement.get(), 0)));
  }
  if (step != SQLITE_DONE) return failure("reading");
  return names;
}

}  // namespace posed
