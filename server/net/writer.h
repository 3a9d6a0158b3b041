// Puts what an outbox gives on a socket, without waiting. Finishes what it began before it takes anything newer.
#pragma once

#include <vector>

#include "server/net/outbox.h"

namespace posed::net {

class Writer {
 public:
  enum class State { done, blocked, broken };

  explicit Writer(Tally& tally) : tally_(tally) {}

  // Until there is nothing more to send now, the socket takes no more, or it is broken. Raises no signal.
  State write(int socket, Outbox& outbox, Nanoseconds now);
  // A frame that goes past the outbox. Call it only when idle.
  State write_frame(int socket, const StreamFrame& frame, Framing framing);
  bool idle() const { return begun_.empty(); }

 private:
  bool fill(Outbox& outbox, Nanoseconds now);
  long send_once(int socket) const;
  void advance(std::size_t bytes);

  Tally& tally_;
  std::vector<Outgoing> begun_;
  std::size_t written_ = 0;  // bytes of its first one
};

}  // namespace posed::net
