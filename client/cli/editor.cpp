#include "client/cli/editor.h"

#include <fcntl.h>
#include <openssl/rand.h>
#include <pwd.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace posed::cli {
namespace {

namespace fs = std::filesystem;

fs::path state_folder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && fs::path(state).is_absolute()) return fs::path(state) / "posectl";
  const char* home = std::getenv("HOME");
  return home == nullptr || *home == '\0' ? fs::path() : fs::path(home) / ".local/state/posectl";
}

bool is_key(const std::string& text) {
  return text.size() == 32 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::string read_key(const fs::path& file) {
  std::string key;
  std::ifstream(file) >> key;
  return is_key(key) ? key : "";
}

std::string new_key() {
  std::array<unsigned char, 16> random{};
  if (RAND_bytes(random.data(), static_cast<int>(random.size())) != 1) return "";
  std::string key;
  for (const unsigned char byte : random) {
    key += "0123456789abcdef"[byte >> 4];
    key += "0123456789abcdef"[byte & 15];
  }
  return key;
}

}  // namespace

std::string editor_key() {
  const fs::path folder = state_folder();
  if (folder.empty()) return "";
  const fs::path file = folder / "editor";
  if (std::string known = read_key(file); !known.empty()) return known;
  const std::string key = new_key();
  std::error_code error;
  fs::create_directories(folder, error);
  // Under its name only when it is whole; whoever is first wins, so that two that start at once agree.
  const fs::path own = folder / ("editor." + std::to_string(::getpid()));
  const int fd = ::open(own.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (fd < 0) return "";
  const bool written = ::write(fd, key.data(), key.size()) == static_cast<ssize_t>(key.size());
  ::close(fd);
  // What is there and is no key is replaced.
  if (written && ::link(own.c_str(), file.c_str()) != 0 && read_key(file).empty()) ::rename(own.c_str(), file.c_str());
  ::unlink(own.c_str());
  return read_key(file);
}

std::string user_name() {
  if (const char* user = std::getenv("USER"); user != nullptr && *user != '\0') return user;
  const passwd* entry = ::getpwuid(::getuid());
  return entry == nullptr ? "" : entry->pw_name;
}

}  // namespace posed::cli
