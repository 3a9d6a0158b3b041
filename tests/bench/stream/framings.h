// How the contestants frame what they send: enough of each protocol to subscribe, and to cut what arrives into frames.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/time.h"

namespace posed::test {

enum class Framing { lines, websocket, nats, mqtt };

struct Piece {
  std::size_t size = 0;      // in what arrived, with its framing; 0: it is not whole yet
  std::string_view payload;  // empty: nothing of a stream
  bool ping = false;         // wants pong()
};

// What a viewer sends to begin. The WebSocket's second half goes out when its handshake is answered.
std::string greeting(Framing framing, const std::string& subscribe);
std::string websocket_text(std::string_view text);  // masked, as a client's must be
// The first piece of `bytes`.
Piece cut(Framing framing, std::string_view bytes);
std::string pong(Framing framing);
// What one publisher sends to a broker: its greeting, and a frame.
std::string publisher_greeting(Framing framing);
std::string published(Framing framing, std::string_view frame);

// The time in a frame, which stands near its beginning.
std::optional<Nanoseconds> stamp_of(std::string_view payload);

}  // namespace posed::test
