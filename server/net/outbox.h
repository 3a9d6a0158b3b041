// What a connection sends next. Knows no sockets and no clock: `now` is a value, in ns of the daemon's clock.
//
// Replies are promises: queued in order, up to a cap. Streams are state: each has one slot, in which a newer frame
// replaces the one that waits. A frame goes out when the peer's credit and its rate allow it, preceded by a stream.lost
// if the peer was too slow for others.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/time.h"
#include "server/net/stream_frame.h"
#include "server/net/subscription.h"
#include "server/net/tally.h"

namespace posed::net {

struct Outgoing {
  SharedLine owner;  // of the bytes
  std::string_view bytes;
  Framing framing = Framing::raw;  // what is still to be put around them
  bool frame = false;              // of a stream
  Nanoseconds t_ns = 0;            // of that frame
};

class Outbox {
 public:
  Outbox(std::size_t max_replies, std::size_t max_reply_bytes, Tally& tally)
      : max_replies_(max_replies), max_reply_bytes_(max_reply_bytes), tally_(tally) {}

  // How replies and frames are put on the wire from now on.
  void set_framing(Framing framing) { framing_ = framing; }
  Framing framing() const { return framing_; }

  // False if the cap is reached: the line was not taken. A line that would be the only one always is.
  [[nodiscard]] bool reply(SharedLine line);
  // Bytes with their framing, in order with the replies and outside the cap.
  void send(SharedLine bytes, Framing framing) { queue(whole(std::move(bytes), framing)); }

  // Replaces the stream's subscription, if any, with all that it held. `present` may be empty.
  void subscribe(const Subscription& subscription, const StreamFrame& present, std::uint64_t seq, Nanoseconds now);
  void unsubscribe(proto::Stream stream) { slot(stream).reset(); }
  void unsubscribe_all();
  // A new frame of a stream; nothing happens without a subscription. False if the cap is reached (not thinned).
  [[nodiscard]] bool put(proto::Stream stream, std::uint64_t seq, const StreamFrame& frame, Nanoseconds now);
  // Whether a new frame may go out at once, past this box. Then it is taken as sent.
  [[nodiscard]] bool pass(proto::Stream stream, std::uint64_t seq, Nanoseconds t_ns, Nanoseconds now);
  // The peer has seen all frames up to `seq`. False without a subscription.
  bool ack(proto::Stream stream, std::uint64_t seq, Nanoseconds now);
  // No ack can come any more.
  void waive_credit();

  std::optional<Outgoing> next(Nanoseconds now);
  // When a frame that waits for nothing but its rate may go.
  std::optional<Nanoseconds> due() const;

  const Subscription* subscription(proto::Stream stream) const;
  bool subscribed() const;
  std::size_t replies() const { return queue_.size() - head_; }
  std::size_t reply_bytes() const { return reply_bytes_; }

 private:
  struct UnderWay {
    std::uint64_t seq;
    Nanoseconds t_ns;
  };
  struct Slot {
    Subscription subscription;
    Nanoseconds period = 0;  // 0: no cap
    Nanoseconds next_due = 0;
    Nanoseconds lost_due = 0;       // a whole period after: until then a newer frame can still take its place
    StreamFrame newest;             // empty: sent
    std::uint64_t seq = 0;          // of newest
    std::uint64_t lost = 0;         // not yet told
    std::vector<UnderWay> unacked;  // ascending; kept only with credit

    bool may_send(Nanoseconds now) const { return now >= next_due && has_credit(); }
    bool has_credit() const;
    void sent(UnderWay frame, Nanoseconds now);
    bool loses(Nanoseconds now);  // that a frame is replaced costs the peer one that its rate would have brought
    Nanoseconds after(Nanoseconds now) const;
  };

  static Outgoing whole(SharedLine bytes, Framing framing) {
    const std::string_view view = *bytes;
    return {std::move(bytes), view, framing, false};
  }
  Outgoing outgoing(const StreamFrame& frame) const {
    return {frame.wire(), frame.as(framing_), Framing::raw, true, frame.t_ns()};
  }
  std::unique_ptr<Slot>& slot(proto::Stream stream) { return slots_[static_cast<std::size_t>(stream)]; }
  void queue(Outgoing out);

  std::size_t max_replies_, max_reply_bytes_;
  Tally& tally_;
  Framing framing_ = Framing::line;
  std::vector<Outgoing> queue_;  // from head_ on
  std::size_t head_ = 0;
  std::size_t reply_bytes_ = 0;
  std::array<std::unique_ptr<Slot>, proto::kStreams> slots_;
  std::size_t turn_ = 0;  // the stream that goes first: none starves the others
};

}  // namespace posed::net
