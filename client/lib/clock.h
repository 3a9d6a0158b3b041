// The daemon's clock as seen from here, to tell how old a frame is.
#pragma once

#include <optional>

#include "client/lib/client.h"
#include "common/time.h"

namespace posed::client {

// What to add to our steady clock for the daemon's `t_ns`, by a few pings: right to half the shortest way there and
// back. None where no ping is answered.
std::optional<Nanoseconds> clock_offset(Client& client);

// Our steady clock.
Nanoseconds steady_now();

}  // namespace posed::client
