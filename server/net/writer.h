// Puts what an outbox gives on a socket, without waiting. Finishes what it began before it takes anything newer.
#pragma once

#include <vector>

#include "server/net/outbox.h"
#include "server/net/wire.h"

namespace posed::net {

class Writer {
 public:
  enum class State { done, blocked, broken };

  explicit Writer(Tally& tally) : tally_(tally) {}

  // Until there is nothing more to send now, the socket takes no more, or it is broken. Raises no signal.
  State write(Wire& wire, Outbox& outbox, Nanoseconds now);
  // A frame that goes past the outbox. Call it only when idle.
  State write_frame(Wire& wire, const StreamFrame& frame, Framing framing, const Clock& clock);
  bool idle() const { return begun_.empty(); }
  // A part of something that is no frame is still to go.
  bool owes() const { return !begun_.empty() && !begun_.back().frame; }
  std::uint64_t sent() const { return sent_; }  // bytes, ever

 private:
  bool fill(Outbox& outbox, Nanoseconds now);
  long send_once(Wire& wire) const;
  void advance(std::size_t bytes, Nanoseconds now);

  Tally& tally_;
  std::vector<Outgoing> begun_;
  std::size_t written_ = 0;  // bytes of its first one
  std::uint64_t sent_ = 0;
};

}  // namespace posed::net
