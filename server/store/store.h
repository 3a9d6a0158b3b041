// What must survive: named scenes, in one SQLite file (WAL, synchronous FULL). A thread of its own does the writing, so
// that neither a solve nor a socket waits for the disk.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/result.h"

namespace posed {

class Store {
 public:
  // Opens or makes DIRECTORY/posed.db. Throws std::runtime_error with one clear sentence where the directory can't be
  // written, or the file is damaged or of a newer version (it is left as it is).
  explicit Store(const std::filesystem::path& directory);
  // Finishes what was asked for.
  ~Store();

  // Each answers on the store's thread, after the disk has it. Errors: "store_failed", "unknown_scene".
  void save(std::string name, std::string document, std::function<void(Status)> done);
  void load(std::string name, std::function<void(Result<std::string>)> done);
  void list(std::function<void(Result<std::vector<std::string>>)> done);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace posed
