// What connections are called and what they are subscribed to. Plain values.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "proto/messages.h"

namespace posed::net {

using ConnectionId = std::uint64_t;                     // never used again within one run
using SharedLine = std::shared_ptr<const std::string>;  // encoded once, without its newline, shared by all receivers

// A subscription as it was granted. Those with equal stream and key get the same lines.
struct Subscription {
  proto::Stream stream = proto::Stream::pose;
  std::uint32_t key = 0;
  double max_rate_hz = 0.0;  // 0: no cap
  int credit = 0;            // frames beyond the last stream.ack; 0: no credit wanted
  bool thinned = true;       // newest wins; false: every line is queued like a reply
  bool binary = false;       // its frames are no text: for a WebSocket only
};

}  // namespace posed::net
