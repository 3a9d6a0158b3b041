// Who fans out frames: posed's network side, a bare epoll loop, and two brokers.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/bench/stream/child.h"
#include "tests/bench/stream/framings.h"

namespace posed::test {

struct Contestant {
  std::string who;  // as in the rows
  Framing framing;
  std::string subscribe;
  bool broker = false;  // the load publishes through it
  std::function<std::unique_ptr<Child>(double rate_hz)> start;
};

// A pose frame as the daemon sends it, of a figure that stands. Its length hardly varies.
std::string pose_frame(std::uint64_t seq, Nanoseconds stamp);

std::string subscribe_line(int credit = 0, double max_rate_hz = 0.0);
// posed over TCP, over WebSocket, and the bare loop that the others are compared with.
Contestant posed_lines();
Contestant posed_websocket();
Contestant bare_loop();
// posed over TCP, with viewers who each ask for the case's rate of a stream of 240 Hz.
Contestant posed_capped(double rate_hz);
// The brokers that are installed. Names the Debian packages of those that are not.
std::vector<Contestant> brokers(std::string& missing);

}  // namespace posed::test
