// A folder for a daemon's data while a case runs.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace posed::test {

class Folder {
 public:
  enum Place { kOnDisk, kInMemory };

  // On the disk: beside the program, since /tmp may lie in memory.
  explicit Folder(Place place = kOnDisk) {
    const std::filesystem::path shared = "/dev/shm";
    const auto where = place == kInMemory && std::filesystem::is_directory(shared)
                           ? shared
                           : std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
    std::string name = (where / "posed-bench-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a folder in " + where.string());
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace posed::test
