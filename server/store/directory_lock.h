// Private to the store: a data directory is one daemon's. The kernel lets go of it however the daemon ends.
#pragma once

#include <filesystem>

namespace posed {

class DirectoryLock {
 public:
  explicit DirectoryLock(const std::filesystem::path& directory);  // throws std::runtime_error
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace posed
