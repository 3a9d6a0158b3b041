#include "server/net/guests.h"

#include <algorithm>

namespace posed::net {
namespace {

constexpr Nanoseconds kSecond = 1'000'000'000;

}  // namespace

bool Guests::Share::take(double rate, Nanoseconds now) {
  if (rate <= 0.0) return true;
  const double most = std::max(rate, 1.0);
  left = fresh ? most : std::min(most, left + 1e-9 * static_cast<double>(now - at) * rate);
  fresh = false;
  at = now;
  if (left < 1.0) return false;
  left -= 1.0;
  return true;
}

bool Guests::enter(const Address& address, Nanoseconds now) {
  forget(now);
  Guest& guest = guests_[address];
  guest.seen = now;
  if (limits_.connections_per_address > 0 && guest.connections >= limits_.connections_per_address) return false;
  ++guest.connections;
  return true;
}

void Guests::leave(const Address& address) {
  const auto guest = guests_.find(address);
  if (guest != guests_.end() && guest->second.connections > 0) --guest->second.connections;
}

bool Guests::may_encrypt(const Address& address, Nanoseconds now) {
  Guest& guest = guests_[address];
  guest.seen = now;
  return guest.handshakes.take(limits_.handshakes_per_second, now);
}

bool Guests::may_ask(const Address& address, Nanoseconds now) {
  Guest& guest = guests_[address];
  guest.seen = now;
  return guest.requests.take(limits_.http_requests_per_second, now);
}

// Who has gone may not come back at once with all of its share; after a second it would have that anyway.
void Guests::forget(Nanoseconds now) {
  if (now - forgot_ < kSecond) return;
  forgot_ = now;
  std::erase_if(
      guests_, [now](const auto& entry) { return entry.second.connections == 0 && now - entry.second.seen > kSecond; });
}

}  // namespace posed::net
