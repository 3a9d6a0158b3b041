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

// The time after `due` in a schedule that late timers do not shift, and that starts anew after a pause, without a
// burst.
Nanoseconds Outbox::Slot::after(Nanoseconds due, Nanoseconds now) const {
  return (now - due < period ? due : now) + period;
}

bool Outbox::Slot::loses(Nanoseconds now) {
  if (period == 0) return true;
  if (now < lost_due) return false;
  lost_due = after(lost_due, now);
  return true;
}

void Outbox::queue(SharedLine bytes, Framing framing, bool frame) {
  reply_bytes_ += bytes->size();
  queue_.push_back({std::move(bytes), framing, frame});
}

bool Outbox::reply(SharedLine line) {
  // A single one may be larger than the cap: whoever made it has bounded it.
  if (replies() >= max_replies_ || (replies() > 0 && reply_bytes_ + line->size() > max_reply_bytes_)) return false;
  queue(std::move(line), framing_, false);
  return true;
}

void Outbox::subscribe(const Subscription& subscription, SharedLine present, std::uint64_t seq, Nanoseconds now) {
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
    s->newest = std::move(present);
    s->seq = seq;
  } else {
    queue(std::move(present), framing_, true);
  }
}

void Outbox::unsubscribe_all() {
  for (auto& s : slots_) s.reset();
}

bool Outbox::put(proto::Stream stream, std::uint64_t seq, SharedLine line, Nanoseconds now) {
  auto& s = slot(stream);
  if (!s) return true;
  if (!s->subscription.thinned) {
    if (replies() >= max_replies_ || reply_bytes_ + line->size() > max_reply_bytes_) return false;
    queue(std::move(line), framing_, true);
    return true;
  }
  if (s->newest) {
    const bool loses = s->loses(now);
    s->lost += loses;
    add(loses ? tally_.dropped : tally_.thinned);
  }
  s->newest = std::move(line);
  s->seq = seq;
  return true;
}

bool Outbox::ack(proto::Stream stream, std::uint64_t seq) {
  auto& s = slot(stream);
  if (!s) return false;
  auto& unacked = s->unacked;
  unacked.erase(unacked.begin(), std::upper_bound(unacked.begin(), unacked.end(), seq));
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
    reply_bytes_ -= out.bytes->size();
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
    if (!s || !s->newest || !s->has_credit() || now < s->next_due) continue;
    if (s->lost > 0) {
      auto told = std::make_shared<const std::string>(proto::encode_lost(s->subscription.stream, s->lost));
      s->lost = 0;
      turn_ = at;  // its frame follows
      return Outgoing{std::move(told), framing_, false};
    }
    if (s->subscription.credit > 0) s->unacked.push_back(s->seq);
    if (s->period > 0) s->next_due = s->after(s->next_due, now);
    s->lost_due = s->next_due + s->period;
    turn_ = at + 1;
    return Outgoing{std::exchange(s->newest, nullptr), framing_, true};
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
