// Where a tracker reads the time: the daemon's clock, passed in. Called on the tracker's own thread, where bytes
// arrive.
#pragma once

#include <functional>

#include "common/time.h"

namespace posed::tracker {

using TimeSource = std::function<Nanoseconds()>;  // nanoseconds on the daemon's clock; [&clock] { return clock.now(); }

}  // namespace posed::tracker
