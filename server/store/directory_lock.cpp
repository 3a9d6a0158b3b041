#include "server/store/directory_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace posed {

DirectoryLock::DirectoryLock(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / "posed.lock";
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) {
    throw std::runtime_error("cannot write " + path.string() + ": " + std::strerror(errno) +
                             "; choose another directory with --data");
  }
  if (::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  ::close(file_);
  throw std::runtime_error("another posed uses the data directory " + directory.string() +
                           ": stop it, or choose another with --data");
}

DirectoryLock::~DirectoryLock() {
  ::close(file_);
}

}  // namespace posed
