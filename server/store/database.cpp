#include "server/store/database.h"

#include <stdexcept>

namespace posed {
namespace {
constexpr int kSchema = 2;

// The steps from one format to the next. None is ever changed.
constexpr const char* kMigrations[kSchema] = {
    "CREATE TABLE scene (name TEXT PRIMARY KEY, document TEXT NOT NULL) WITHOUT ROWID",
    // The live scene by paths of its document; the path '' has the scene's own revision.
    "CREATE TABLE live (path TEXT PRIMARY KEY, revision INTEGER NOT NULL, document TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE once (number INTEGER PRIMARY KEY, uuid TEXT NOT NULL UNIQUE, method TEXT NOT NULL,"
    " result TEXT NOT NULL)",
};

void bind(sqlite3_stmt* statement, int index, const std::string& text) {
  sqlite3_bind_text(statement, index, text.data(), static_cast<int>(text.size()), SQLITE_STATIC);
}

Error unknown_scene(const std::string& name) {
  return {"unknown_scene", "no scene was saved as " + name.substr(0, 64), "/name", "scene.list names them"};
}

std::string text_of(sqlite3_stmt* statement, int column) {
  return {reinterpret_cast<const char*>(sqlite3_column_text(statement, column)),
          static_cast<std::size_t>(sqlite3_column_bytes(statement, column))};
}

}  // namespace

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
  // A file that is refused is left as it is: closing it must not tidy up its log.
  sqlite3_db_config(db, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  const int found = number("PRAGMA user_version");
  if (found > kSchema) {
    throw std::runtime_error(file.string() + " was written by a newer posed (format " + std::to_string(found) +
                             "); it is left as it is: update posed, or choose another directory with --data");
  }
  const bool ours = number("SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'scene'") > 0;
  if (found == 0 ? number("SELECT count(*) FROM sqlite_master") > 0 : !ours) refuse("another program made it");
  if (found > 0) check();
  execute("PRAGMA journal_mode = WAL");
  execute("PRAGMA synchronous = FULL");
  sqlite3_db_config(db, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 0, nullptr);
  migrate(found);
}

// Before anything is written: a damaged file is for whoever can mend it.
void Database::check() {
  const Statement statement = prepare("PRAGMA quick_check(1)");
  const bool answered = statement && sqlite3_step(statement.get()) == SQLITE_ROW;
  const std::string found = answered ? text_of(statement.get(), 0) : sqlite3_errmsg(db_.get());
  if (found == "ok") return;
  throw std::runtime_error(file_.string() + " is damaged (" + found.substr(0, 200) +
                           "); it is left as it is: bring back a copy, or choose another directory with --data");
}

void Database::migrate(int found) {
  if (found == kSchema) return;
  execute("BEGIN IMMEDIATE");
  for (int i = found; i < kSchema; ++i) execute(kMigrations[i]);
  execute(("PRAGMA user_version = " + std::to_string(kSchema)).c_str());
  execute("COMMIT");
}

StoredScene Database::live() {
  StoredScene scene;
  const Statement parts = prepare("SELECT path, revision, document FROM live ORDER BY path");
  if (!parts) refuse(sqlite3_errmsg(db_.get()));
  int step = sqlite3_step(parts.get());
  for (; step == SQLITE_ROW; step = sqlite3_step(parts.get())) {
    StoredPart part{text_of(parts.get(), 0), static_cast<std::uint64_t>(sqlite3_column_int64(parts.get(), 1)),
                    text_of(parts.get(), 2)};
    if (part.path.empty())
      scene.revision = part.revision;
    else
      scene.parts.push_back(std::move(part));
  }
  if (step != SQLITE_DONE) refuse(sqlite3_errmsg(db_.get()));
  const Statement once = prepare("SELECT uuid, method, result FROM once ORDER BY number");
  if (!once) refuse(sqlite3_errmsg(db_.get()));
  for (step = sqlite3_step(once.get()); step == SQLITE_ROW; step = sqlite3_step(once.get()))
    scene.once.push_back({text_of(once.get(), 0), text_of(once.get(), 1), text_of(once.get(), 2)});
  if (step != SQLITE_DONE) refuse(sqlite3_errmsg(db_.get()));
  return scene;
}

Status Database::run(const char* sql) {
  if (sqlite3_exec(db_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) return failure("storing");
  return Ok{};
}

Status Database::commit(const StoredChanges& changes) {
  Status status = run("BEGIN IMMEDIATE");
  if (status) status = write(changes);
  if (status) status = run("COMMIT");
  // Some errors have rolled back already.
  if (!status && !sqlite3_get_autocommit(db_.get())) (void)run("ROLLBACK");
  return status;
}

Status Database::write(const StoredChanges& changes) {
  if (changes.anew) {
    if (Status gone = run("DELETE FROM live"); !gone) return gone;
  }
  const Statement set =
      prepare("INSERT INTO live VALUES (?1, ?2, ?3) ON CONFLICT (path) DO UPDATE SET revision = ?2, document = ?3");
  const Statement remove = prepare("DELETE FROM live WHERE path = ?1");
  const Statement once = prepare("INSERT OR REPLACE INTO once (uuid, method, result) VALUES (?1, ?2, ?3)");
  if (!set || !remove || !once) return failure("storing");
  const auto done = [](const Statement& statement) {
    const bool good = sqlite3_step(statement.get()) == SQLITE_DONE;
    sqlite3_reset(statement.get());
    return good;
  };
  const auto set_part = [&](const std::string& path, std::uint64_t revision, const std::string& document) {
    bind(set.get(), 1, path);
    sqlite3_bind_int64(set.get(), 2, static_cast<sqlite3_int64>(revision));
    bind(set.get(), 3, document);
    return done(set);
  };
  for (const StoredPart& part : changes.set) {
    if (!set_part(part.path, part.revision, part.document)) return failure("storing");
  }
  for (const std::string& path : changes.removed) {
    bind(remove.get(), 1, path);
    if (!done(remove)) return failure("storing");
  }
  for (const StoredOnce& edit : changes.once) {
    bind(once.get(), 1, edit.uuid);
    bind(once.get(), 2, edit.method);
    bind(once.get(), 3, edit.result);
    if (!done(once)) return failure("storing");
  }
  if (!changes.once.empty()) {
    const std::string most = std::to_string(kMostOnce);
    if (Status old = run(("DELETE FROM once WHERE number <= (SELECT max(number) FROM once) - " + most).c_str()); !old)
      return old;
  }
  if (!set_part("", changes.revision, "")) return failure("storing");
  return Ok{};
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

Status Database::remove(const std::string& name) {
  const Statement statement = prepare("DELETE FROM scene WHERE name = ?1");
  if (!statement) return failure("removing");
  bind(statement.get(), 1, name);
  if (sqlite3_step(statement.get()) != SQLITE_DONE) return failure("removing");
  if (sqlite3_changes(db_.get()) == 0) return unknown_scene(name);
  return Ok{};
}

Result<std::string> Database::load(const std::string& name) {
  const Statement statement = prepare("SELECT document FROM scene WHERE name = ?1");
  if (!statement) return failure("reading");
  sqlite3_bind_text(statement.get(), 1, name.data(), static_cast<int>(name.size()), SQLITE_STATIC);
  const int step = sqlite3_step(statement.get());
  if (step == SQLITE_DONE) return unknown_scene(name);
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
