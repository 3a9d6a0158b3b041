// posectl's help, of one command and as a man page, made of the command line's own tables.
#pragma once

#include <string>
#include <vector>

#include "common/result.h"

namespace CLI {
class App;
}

namespace posed::cli {

// Error: "bad_usage" where there is no such command.
Result<std::string> help_of(const CLI::App& app, const std::vector<std::string>& words);
Result<std::string> man_page(const CLI::App& app);

}  // namespace posed::cli
