#include "server/net/outbox.h"

#include <algorithm>
#include <cmath>

#include "proto/codec.h"

namespace posed::net {
namespace {
constexpr int kMaxCredit = 1024;  // bounds the list of frames that wait for an ack
constexpr double kMinRateHz = 1e-3;
}  // namespace

bool Outbox::Slot::has_credit() const {
  return subscription.credit <= 0 || unacked.size() < static_cast<std::size_t>(subscription.credit);
}

// The schedule is the clock's own: late timers do not shift it, a pause earns no burst, and all who ask for one rate
// are due at once.
Nanoseconds Outbox::Slot::after(Nanoseconds now) const {
  return (now / period + 1) * period;
}

bool Outbox::Slot::loses(Nanoseconds now) {
  if (period == 0) return true;
  if (now < lost_due) return false;
  lost_due = after(now);
  return true;
}

void Outbox::Slot::sent(UnderWay frame, Nanoseconds now) {
  if (subscription.credit > 0) unacked.push_back(frame);
  if (period > 0) next_due = after(now);
  lost_due = next_due + period;
}

void Outbox::queue(Outgoing out) {
  reply_bytes_ += out.bytes.size();
  queue_.push_back(std::move(out));
}

bool Outbox::reply(SharedLine line) {
  // A single one may be larger than the cap: whoever made it has bounded it.
  if (replies() >= max_replies_ || (replies() > 0 && reply_bytes_ + line->size() > max_reply_bytes_)) return false;
  queue(whole(std::move(line), framing_));
  return true;
}

void Outbox::subscribe(const Subscription& subscription, const StreamFrame& present, std::uint64_t seq,
                       Nanoseconds now) {
  auto& s = slot(subscription.stream);
  s = std::make_unique<Slot>();
  s->subscription = subscription;
  s->subscription.credit = std::min(subscription.credit, kMaxCredit);
  if (subscription.max_rate_hz > 0.0) {
    s->period = std::llround(1e9 / std::max(subscription.max_rate_hz, kMinRateHz));
  }
  s->next_due = now;
  s->lost_due = now + s->period;
  if (!present) return;
  if (subscription.thinned) {
    s->newest = present;
    s->seq = seq;
  } else {
    queue(outgoing(present));
  }
}

void Outbox::unsubscribe_all() {
  for (auto& s : slots_) s.reset();
}

bool Outbox::put(proto::Stream stream, std::uint64_t seq, const StreamFrame& frame, Nanoseconds now) {
  auto& s = slot(stream);
  if (!s) return true;
  if (!s->subscription.thinned) {
    if (replies() >= max_replies_ || reply_bytes_ + frame.size() > max_reply_bytes_) return false;
    queue(outgoing(frame));
    return true;
  }
  if (s->newest) {
    const bool loses = s->loses(now);
    s->lost += loses;
    add(loses ? tally_.dropped : tally_.thinned);
  }
  s->newest = frame;
  s->seq = seq;
  return true;
}

bool Outbox::pass(proto::Stream stream, std::uint64_t seq, Nanoseconds t_ns, Nanoseconds now) {
  Slot* const s = slot(stream).get();
  if (!s || s->newest || s->lost > 0 || replies() > 0 || !s->subscription.thinned || !s->may_send(now)) return false;
  s->sent({seq, t_ns}, now);
  return true;
}

bool Outbox::ack(proto::Stream stream, std::uint64_t seq, Nanoseconds now) {
  auto& s = slot(stream);
  if (!s) return false;
  auto& unacked = s->unacked;
  const auto end = std::find_if(unacked.begin(), unacked.end(), [&](const UnderWay& frame) { return frame.seq > seq; });
  // The newest of them is what the peer sees; it may acknowledge several at once.
  if (end != unacked.begin() && std::prev(end)->t_ns != 0) tally_.acked_age.add(now - std::prev(end)->t_ns);
  unacked.erase(unacked.begin(), end);
  return true;
}

void Outbox::waive_credit() {
  for (auto& s : slots_) {
    if (s) s->subscription.credit = 0;
  }
}

std::optional<Outgoing> Outbox::next(Nanoseconds now) {
  if (head_ < queue_.size()) {
    Outgoing out = std::move(queue_[head_++]);
    reply_bytes_ -= out.bytes.size();
    if (head_ == queue_.size()) {
      queue_.clear();
      head_ = 0;
    } else if (head_ >= 64 && 2 * head_ >= queue_.size()) {
      queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(head_));
      head_ = 0;
    }
    return out;
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const std::size_t at = (turn_ + i) % slots_.size();
    Slot* const s = slots_[at].get();
    if (!s || !s->newest || !s->may_send(now)) continue;
    if (s->lost > 0) {
      auto told = std::make_shared<const std::string>(proto::encode_lost(s->subscription.stream, s->lost));
      s->lost = 0;
      turn_ = at;  // its frame follows
      return whole(std::move(told), framing_);
    }
    s->sent({s->seq, s->newest.t_ns()}, now);
    turn_ = at + 1;
    return outgoing(std::exchange(s->newest, {}));
  }
  return std::nullopt;
}

std::optional<Nanoseconds> Outbox::due() const {
  std::optional<Nanoseconds> due;
  for (const auto& s : slots_) {
    if (s && s->newest && s->has_credit() && (!due || s->next_due < *due)) due = s->next_due;
  }
  return due;
}

const Subscription* Outbox::subscription(proto::Stream stream) const {
  const auto& s = slots_[static_cast<std::size_t>(stream)];
  return s ? &s->subscription : nullptr;
}

bool Outbox::subscribed() const {
  return std::any_of(slots_.begin(), slots_.end(), [](const auto& s) { return s != nullptr; });
}

}  // namespace posed::net
