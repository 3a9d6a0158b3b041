// Who else has a device open.
#pragma once

#include <string>

namespace posed::tracker {

// As "PiMgr (process 812)", from /proc; empty where nobody does or that cannot be seen (another user's programs need
// root). `node`: its path without symbolic links.
std::string holder_of(const std::string& node);

}  // namespace posed::tracker
