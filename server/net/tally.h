// Counts of what the network loop did. Written by its thread, read by any.
#pragma once

#include <atomic>
#include <cstdint>

#include "server/net/ages.h"

namespace posed::net {

struct Counters {
  std::uint64_t connections = 0;  // open now, of every face
  std::uint64_t peers = 0;        // open now, of those that speak the protocol
  std::uint64_t accepted = 0, refused = 0;
  std::uint64_t lines = 0, replies = 0, http_requests = 0;
  std::uint64_t frames = 0;   // stream frames handed to the kernel
  std::uint64_t dropped = 0;  // frames replaced before a slow peer could take them; each was told by stream.lost
  std::uint64_t thinned = 0;  // frames left out because the peer asked for a lower rate
  std::uint64_t bytes_in = 0, bytes_out = 0;
  AgeCounts sent_age;   // of frames, from their t_ns until the kernel had taken them
  AgeCounts acked_age;  // until a peer with credit had acknowledged them: what it sees, and the way back
};

struct Tally {
  using Count = std::atomic<std::uint64_t>;
  Count connections{0}, peers{0}, accepted{0}, refused{0}, lines{0}, replies{0}, http_requests{0}, frames{0},
      dropped{0}, thinned{0}, bytes_in{0}, bytes_out{0};
  AgeMeter sent_age, acked_age;

  Counters read() const {
    const auto get = [](const Count& count) { return count.load(std::memory_order_relaxed); };
    return {get(connections), get(peers),         get(accepted),   get(refused),    get(lines),
            get(replies),     get(http_requests), get(frames),     get(dropped),    get(thinned),
            get(bytes_in),    get(bytes_out),     sent_age.read(), acked_age.read()};
  }
};

inline void add(Tally::Count& count, std::uint64_t n = 1) {
  count.store(count.load(std::memory_order_relaxed) + n, std::memory_order_relaxed);
}
inline void subtract(Tally::Count& count) {
  count.store(count.load(std::memory_order_relaxed) - 1, std::memory_order_relaxed);
}

}  // namespace posed::net
