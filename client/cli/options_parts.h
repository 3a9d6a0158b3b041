// Private to the options: groups of subcommands that have files of their own.
#pragma once

#include <functional>

#include "client/cli/commands.h"

namespace CLI {
class App;
}

namespace posed::cli {

// A subcommand's callback only notes what to do; it is done when the daemon is there.
using Run = std::function<int(const Session&)>;

void add_tracker(CLI::App& app, Run& run);
void add_camera(CLI::App& app, Run& run);

}  // namespace posed::cli
