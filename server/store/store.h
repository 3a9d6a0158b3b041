// What must survive, in one SQLite file (WAL, synchronous FULL): the live scene, entity by entity, and named scenes. A
// thread of its own does the writing, so that neither a solve nor a socket waits for the disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/result.h"

namespace posed {

// A part of the live scene's document, by its path: "/goals/g1", "/figures/body" (without q), "/figures/body/q".
struct StoredPart {
  std::string path;
  std::uint64_t revision = 0;  // the entity's own
  std::string document;        // JSON text
};
// An edit that may be sent again, and the result that it had.
struct StoredOnce {
  std::string uuid, method, result;
};
// Of one transaction.
struct StoredChanges {
  std::uint64_t revision = 0;  // of the scene, after it
  bool anew = false;           // whatever was there before goes
  std::vector<StoredPart> set;
  std::vector<std::string> removed;
  std::vector<StoredOnce> once;
};
struct StoredScene {
  std::uint64_t revision = 0;  // 0: there is none
  std::vector<StoredPart> parts;
  std::vector<StoredOnce> once;  // oldest first; the last kMostOnce
};
inline constexpr int kMostOnce = 1000;

class Store {
 public:
  // Opens or makes DIRECTORY/posed.db. Throws std::runtime_error with one clear sentence where the directory can't be
  // written or is another daemon's, or the file is damaged or of a newer version (it is left as it is).
  explicit Store(const std::filesystem::path& directory);
  // Finishes what was asked for.
  ~Store();

  // The scene that was live when the store was last closed, or lost its power.
  const StoredScene& live() const;

  // Each answers on the store's thread, after the disk has it. Errors: "store_failed", "unknown_scene".
  void commit(StoredChanges changes, std::function<void(Status)> done);  // all of it or nothing
  void save(std::string name, std::string document, std::function<void(Status)> done);
  void load(std::string name, std::function<void(Result<std::string>)> done);
  void remove(std::string name, std::function<void(Status)> done);
  void list(std::function<void(Result<std::vector<std::string>>)> done);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace posed
