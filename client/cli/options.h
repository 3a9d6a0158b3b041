// posectl's command line.
#pragma once

#include <functional>
#include <string>
#include <variant>

#include "client/cli/commands.h"

namespace posed::cli {

struct Options {
  std::string host;
  bool json = false;
  client::Identity identity;
  std::function<int(const Session&)> run;
  std::function<int()> run_alone;  // in its place: a command that needs no daemon
};

// The options, or the exit code where all is said already (help, or what is wrong).
std::variant<Options, int> parse_options(int argc, const char* const* argv);

}  // namespace posed::cli
