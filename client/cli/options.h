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
  std::function<int(const Session&)> run;
};

// The options, or the exit code where all is said already (help, or what is wrong).
std::variant<Options, int> parse_options(int argc, const char* const* argv);

}  // namespace posed::cli
