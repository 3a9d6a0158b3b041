// The whole daemon, as it is installed, and its clock as a viewer reads it.
#pragma once

#include <memory>
#include <string>

#include "client/lib/client.h"
#include "tests/bench/stream/child.h"

namespace posed::test {

// `tracker`: as after --tracker. It keeps what must survive in the folder `data`.
std::unique_ptr<Child> start_daemon(const std::string& tracker, const std::string& data);
client::Client connect_to_daemon(const Child& daemon);  // throws std::runtime_error
// What the daemon's clock is ahead of ours: the pings with the shortest way there and back decide.
Nanoseconds clock_offset(client::Client& client);

}  // namespace posed::test
