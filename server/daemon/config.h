// What the command line and the configuration file say.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/log.h"

namespace posed {

struct Config {
  std::string host = "127.0.0.1";
  std::uint16_t port = 19870;
  std::vector<std::string> trackers;  // KIND[:ARG]
  std::filesystem::path captures;     // where trackers write what they hear; empty: nowhere
  std::filesystem::path data;
  std::filesystem::path viewer;
  std::filesystem::path scenes;
  std::string scene_template = "standing";
  bool begin_anew = false;  // with it, whatever scene the store has
  LogLevel log = LogLevel::info;
  std::filesystem::path tokens;                    // empty: nobody is asked for one
  std::filesystem::path tls_certificate, tls_key;  // empty: no TLS
  bool beyond_loopback = false;                    // others can reach the address
  std::vector<std::string> names;                  // by which browsers may call us, besides the machine's own
  std::string solve_method = "springs";            // or "reach_tree"
  double solve_deadline_ms = 20.0;                 // a solve that takes longer ends with the best pose so far
};

// Reads the arguments. Where the program has to end instead (--help, --version, a mistake), prints what there is to
// say, one line for a mistake, and sets `exit_code`: 0 or 2.
std::optional<Config> read_config(int argc, const char* const* argv, int& exit_code);

}  // namespace posed
