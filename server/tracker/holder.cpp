#include "server/tracker/holder.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

namespace posed::tracker {
namespace {

namespace fs = std::filesystem;

// Processes come and go while one looks, and most may not be looked into: both end the list, neither throws.
std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    found.push_back(at->path());
  }
  return found;
}

}  // namespace

std::string holder_of(const std::string& node) {
  for (const fs::path& process : entries("/proc")) {
    const std::string pid = process.filename();
    if (pid.find_first_not_of("0123456789") != std::string::npos || pid == std::to_string(::getpid())) continue;
    for (const fs::path& descriptor : entries(process / "fd")) {
      std::error_code ignored;
      if (fs::read_symlink(descriptor, ignored) != node) continue;
      std::ifstream comm(process / "comm");
      std::string name;
      std::getline(comm, name);
      return name.append(" (process ").append(pid).append(")");
    }
  }
  return {};
}

}  // namespace posed::tracker
