// What FASTRAK and ISOTRAK II are told of what has been asked of them. Pure.
// Source: FASTRAK manual OPM00PI002 Rev G, commands H, l, v, x; VRPN's driver has l, v and x of the ISOTRAK II, too,
// and says H as the FASTRAK does.
#pragma once

#include <string>
#include <vector>

#include "server/tracker/preferences.h"

namespace posed::tracker {

// `stations`: the highest that there can be. Their rate is shared: it follows from how many are on.
Abilities fastrak_abilities(int stations);
// As it comes from the factory: forward half, no filters, all stations that its switches say.
Preferences fastrak_defaults();

// One command a string. `on`: the stations that are switched on (bit 0 is station 1); `found`: those that were when it
// was first asked.
std::vector<std::string> fastrak_switches(const Preferences& wish, int stations, unsigned on, unsigned found);
std::vector<std::string> fastrak_settings(const Preferences& wish, int stations);

}  // namespace posed::tracker
