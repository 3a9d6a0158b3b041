// What a connection puts up with: silence, replies that nobody reads, too much at once, and no TLS.
#include <algorithm>

#include "common/log.h"
#include "server/net/connection.h"
#include "server/net/http_site.h"
#include "server/net/websocket_frames.h"

namespace posed::net {

void Connection::check(Nanoseconds now) {
  if (deadline_ != 0 && now >= deadline_) return close("it took too long");
  // Who fetches pages has deadlines of its own.
  const Nanoseconds admission = hub_.options.limits.admission;
  if (admission != 0 && !admitted_ && deadline_ == 0 && now - since_ >= admission)
    return close("it did not show who it is");
  check_heartbeat(now);
  check_reading(now);
}

// Frames are data and may be thinned to nothing; a silent peer is asked on its own.
void Connection::check_heartbeat(Nanoseconds now) {
  // What we do not read we can not hear.
  if (closed_ || parting_ || !opened_ || face_->stuck()) return void(heard_ = now);
  const Nanoseconds limit = hub_.options.limits.heartbeat;
  if (now - heard_ < limit) return void(pinged_ = 0);
  const SharedLine ping = face_->heartbeat();
  if (!ping) return;
  if (pinged_ != 0 && now - heard_ >= 3 * limit) return close("it no longer answers");
  if (pinged_ != 0 && now - pinged_ < limit) return;
  pinged_ = now;
  send(ping);
  update();
}

// Frames that are not taken are replaced by newer ones. Replies can not be, and shall not be kept for ever.
void Connection::check_reading(Nanoseconds now) {
  const bool owed = outbox_.replies() > 0 || writer_.owes();
  if (closed_ || !owed || stuck_since_ == 0 || writer_.sent() != stuck_at_) {
    stuck_since_ = owed ? now : 0;
    stuck_at_ = writer_.sent();
    return;
  }
  if (now - stuck_since_ < hub_.options.limits.unread_reply) return;
  log_warning("closing " + address_ + ": it does not read the replies that it asked for");
  close("it does not read");
}

void Connection::overflow() {
  part(close_code::kPolicy,
       Error{"too_large",
             std::to_string(outbox_.replies()) + " lines of " + std::to_string(outbox_.reply_bytes()) +
                 " bytes wait unread",
             "", "read faster, or ask for less at once"},
       Owed::forget);
}

void Connection::refill(Nanoseconds now) {
  const double rate = hub_.options.limits.lines_per_second;
  if (rate <= 0.0) return;
  allowance_ = std::min(std::max(rate, 1.0), allowance_ + 1e-9 * static_cast<double>(now - refilled_) * rate);
  refilled_ = now;
}

// The peer has sent as much as it may for now.
void Connection::arm_allowance() {
  const double rate = hub_.options.limits.lines_per_second;
  if (closed_ || allowed_ != 0 || rate <= 0.0 || allowance_ >= 1.0 || !face_->stuck()) return;
  allowed_ = refilled_ + static_cast<Nanoseconds>(1e9 * (1.0 - allowance_) / rate) + 1;
  hub_.wakes.at(allowed_, weak_from_this());
}

// A client that takes us for a TLS server may have been led here, with lines for us in what it says.
void Connection::tls_refused() {
  part(close_code::kPolicy, Error{"invalid_request", "no TLS is spoken here", "", "connect with tcp:// or http://"},
       Owed::forget);
}

bool Connection::plain_refused(Detected detected) {
  const Options& options = hub_.options;
  if (!options.tls || wire_.encrypted() || (options.plain_on_loopback && remote_.is_loopback())) return false;
  const Error error{"tls_required", "this daemon speaks TLS only", "", "connect with tls:// or https://"};
  if (detected == Detected::http) {
    const HttpReply reply = plain_reply(426, error.message + ": " + error.hint);
    send(std::make_shared<const std::string>(encode_http_header(reply, false)));
    send(reply.body);
    part(0, std::nullopt, Owed::forget);
  } else {
    part(close_code::kPolicy, error, Owed::forget);
  }
  return true;
}

}  // namespace posed::net
