#include "client/lib/clock.h"

namespace posed::client {

Nanoseconds steady_now() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::optional<Nanoseconds> clock_offset(Client& client) {
  constexpr int kPings = 5;
  std::optional<Nanoseconds> offset;
  // The ping with the shortest way there and back decides.
  Nanoseconds best = INT64_MAX;
  for (int i = 0; i < kPings; ++i) {
    const Nanoseconds before = steady_now();
    const auto ping = client.call<proto::PingResult>(proto::SessionPing{});
    const Nanoseconds after = steady_now();
    if (!ping) return offset;
    if (after - before >= best) continue;
    best = after - before;
    offset = (ping->receive_t_ns + ping->send_t_ns) / 2 - (before + after) / 2;
  }
  return offset;
}

}  // namespace posed::client
