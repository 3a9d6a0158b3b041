#include "server/net/connection.h"

#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <cerrno>

#include "common/log.h"
#include "proto/codec.h"
#include "server/net/detect_face.h"
#include "server/net/http_face.h"
#include "server/net/line_face.h"
#include "server/net/requests.h"
#include "server/net/websocket_face.h"

namespace posed::net {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

constexpr int kReadsInARow = 4;                // then others have their turn
constexpr int kUnsentBytes = 16 << 10;         // that the kernel takes from us before they go out to a subscriber
constexpr std::size_t kBurstBytes = 64 << 10;  // of replies, that may gather before they are sent
constexpr std::size_t kFirstReply = 64 << 10;  // bytes expected of a reply before any has come

}  // namespace

Connection::Connection(Hub& hub, Socket socket, ConnectionId id, std::string address, asio::ip::address remote)
    : hub_(hub),
      socket_(std::move(socket)),
      id_(id),
      address_(std::move(address)),
      remote_(std::move(remote)),
      wire_(socket_.native_handle()),
      outbox_(hub.options.limits.replies, hub.options.limits.reply_bytes, hub.tally),
      writer_(hub.tally),
      expected_reply_(kFirstReply),
      allowance_(hub.options.limits.lines_per_second) {
  add(hub_.tally.connections);
}

Connection::~Connection() {
  subtract(hub_.tally.connections);
}

void Connection::start() {
  error_code ignored;
  socket_.non_blocking(true, ignored);
  socket_.set_option(asio::ip::tcp::no_delay(true), ignored);
  // A peer whose machine is gone is found out within a minute, also where nothing is said.
  socket_.set_option(asio::socket_base::keep_alive(true), ignored);
  for (const auto& [option, value] :
       {std::pair{TCP_KEEPIDLE, 20}, std::pair{TCP_KEEPINTVL, 10}, std::pair{TCP_KEEPCNT, 4}}) {
    ::setsockopt(socket_.native_handle(), IPPROTO_TCP, option, &value, sizeof value);
  }
  since_ = heard_ = hub_.clock.now();
  face_ = std::make_unique<DetectFace>(*this, hub_.options.limits.http_request,
                                       [this](Detected detected) { return make_face(detected); });
  arm_read();
}

std::unique_ptr<Face> Connection::make_face(Detected detected) {
  const Limits& limits = hub_.options.limits;
  if (detected == Detected::tls) tls_refused();
  if (detected == Detected::tls || plain_refused(detected)) return std::make_unique<LineFace>(*this, limits.line_bytes);
  if (detected == Detected::http) return std::make_unique<HttpFace>(*this, hub_.site, limits, hub_.tally);
  return std::make_unique<LineFace>(*this, limits.line_bytes);
}

// ---- what the server asks for ----

void Connection::reply(const SharedLine& line) {
  if (closed_ || unanswered_ == 0) return;
  --unanswered_;
  if (!line || (parting_ && !parting_->waits)) return;
  add(hub_.tally.replies);
  expected_reply_ = std::max(line->size(), expected_reply_ - expected_reply_ / 8);
  if (outbox_.reply_bytes() + line->size() > kBurstBytes) pump();
  if (!closed_ && !outbox_.reply(line)) overflow();
}

void Connection::notify(const SharedLine& line) {
  if (!closed_ && !parting_ && idle()) outbox_.send(line, outbox_.framing());
}

void Connection::subscribe(const Subscription& subscription, const StreamFrame& present, std::uint64_t seq) {
  if (closed_ || parting_) return;
  if (!small_buffer_) {
    // Bytes in the kernel can't be taken back: what waits there is the past.
    small_buffer_ = true;
    error_code ignored;
    socket_.set_option(asio::socket_base::send_buffer_size(hub_.options.limits.subscriber_send_buffer), ignored);
    const int unsent = kUnsentBytes;
    ::setsockopt(socket_.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent, sizeof(unsent));
  }
  outbox_.subscribe(subscription, present, seq, hub_.clock.now());
  if (ended_) outbox_.waive_credit();
  hub_.subscriptions.add(this, subscription.stream, subscription.key);
}

void Connection::unsubscribe(proto::Stream stream) {
  hub_.subscriptions.remove(this, stream);
  outbox_.unsubscribe(stream);
}

void Connection::publish(proto::Stream stream, std::uint64_t seq, const StreamFrame& frame, Nanoseconds now,
                         bool send) {
  if (closed_) return;
  if (send && !write_armed_ && writer_.idle() && outbox_.pass(stream, seq, frame.t_ns(), now))
    return written(writer_.write_frame(wire_, frame, outbox_.framing(), hub_.clock));
  if (!outbox_.put(stream, seq, frame, now)) {
    overflow();
    return update();
  }
  if (send) flush();
}

void Connection::flush() {
  pump();
  arm_rate();
}

void Connection::part_now() {
  part(close_code::kGoingAway, std::nullopt, Owed::forget);
  update();
}

// ---- what a face asks for ----

bool Connection::room() const {
  const Limits& limits = hub_.options.limits;
  if (limits.lines_per_second > 0.0 && allowance_ < 1.0) return false;
  if (closed_ || parting_ || unanswered_ >= limits.unanswered || outbox_.reply_bytes() >= limits.unread_bytes)
    return false;
  // Nor more than whose replies will find room, as far as the last ones tell.
  return unanswered_ == 0 || unanswered_ * expected_reply_ < limits.reply_bytes / 2;
}

void Connection::hand_up(std::string_view text) {
  add(hub_.tally.lines);
  allowance_ -= 1.0;
  proto::Line line = proto::decode_line(text);
  take_acks(line, outbox_, receive_t_ns_);
  if (line.entries.empty()) return;
  ++unanswered_;
  hub_.handlers.line(id_, std::move(line), receive_t_ns_);
}

void Connection::open(bool websocket) {
  opened_ = true;
  since_ = hub_.clock.now();
  add(hub_.tally.peers);
  outbox_.set_framing(websocket ? Framing::text : Framing::line);
  hub_.handlers.opened(id_, Peer{address_, websocket});
}

void Connection::become(std::unique_ptr<Face> face, std::string_view rest) {
  retired_.push_back(std::move(face_));
  face_ = std::move(face);
  if (!rest.empty()) face_->take(rest);
}

void Connection::part(std::uint16_t close_code, std::optional<Error> last_words, Owed owed) {
  if (closed_ || (parting_ && (!parting_->waits || owed == Owed::wait))) return;
  if (last_words) log_warning("closing " + address_ + ": " + last_words->message);
  outbox_.unsubscribe_all();
  parting_ = Parting{close_code, std::move(last_words), owed == Owed::wait, false, false};
}

// ---- after each event ----

void Connection::update() {
  retired_.clear();
  refill(hub_.clock.now());
  for (;;) {
    pump();
    if (closed_ || parting_ || !face_->ready()) break;
    face_->take({});
  }
  close_if_done();
  arm_read();
  arm_rate();
  arm_allowance();
}

// TLS begins with a byte that begins nothing else. False: nothing has come yet.
bool Connection::sniff() {
  if (sniffed_ || !hub_.options.tls) return true;
  const int first = wire_.first_byte();
  if (first == Wire::kNothingYet) return false;
  sniffed_ = true;
  if (first != kTlsHandshake) return true;
  if (!hub_.guests.may_encrypt(remote_, hub_.clock.now())) {
    add(hub_.tally.refused);
    close("too many TLS handshakes of this address");
    return false;
  }
  wire_.encrypt(*hub_.options.tls);
  deadline(hub_.options.limits.http_request);  // for the handshake and what follows it
  return true;
}

void Connection::on_readable() {
  if (!sniff()) return closed_ ? void() : update();  // what comes the next moment may be TLS
  refill(hub_.clock.now());
  std::vector<char>& scratch = hub_.scratch;
  for (int i = 0; i < kReadsInARow; ++i) {
    const long got = wire_.receive(scratch.data(), scratch.size());
    if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) break;
    if (got == 0) {
      on_end();
      break;
    }
    if (got < 0) return close("the peer is gone");
    const auto size = static_cast<std::size_t>(got);
    add(hub_.tally.bytes_in, size);
    if (!parting_) {
      receive_t_ns_ = heard_ = hub_.clock.now();
      face_->take(std::string_view(scratch.data(), size));
    }
    if (closed_ || face_->stuck() || (size < scratch.size() && !wire_.encrypted())) break;
  }
  update();
}

void Connection::on_end() {
  if (parting_) return close("parted");
  ended_ = true;
  outbox_.waive_credit();
  receive_t_ns_ = hub_.clock.now();
  const Face* const before = face_.get();
  face_->end();
  if (face_.get() != before) face_->end();
  // Nothing is read any more that would show when the peer closes wholly.
  socket_.async_wait(Socket::wait_error, [self = shared_from_this()](error_code error) {
    if (!error) self->close("the peer is gone");
  });
}

void Connection::say_goodbye() {
  parting_->said = true;
  if (deadline_ == 0) deadline(hub_.options.limits.farewell);
  if (parting_->last_words) {
    outbox_.send(std::make_shared<const std::string>(proto::encode_error("null", *parting_->last_words)),
                 outbox_.framing());
  }
  if (SharedLine last = face_->goodbye(parting_->close_code)) send(std::move(last));
  pump();
}

void Connection::close_if_done() {
  if (closed_) return;
  if (!parting_) {
    if (ended_ && unanswered_ == 0 && idle() && !outbox_.subscribed()) close("the peer has ended");
    return;
  }
  if (!parting_->said && (!parting_->waits || unanswered_ == 0)) say_goodbye();
  if (closed_ || !parting_->said || parting_->shut || !idle()) return;
  parting_->shut = true;
  error_code ignored;
  wire_.end();
  socket_.shutdown(Socket::shutdown_send, ignored);
  if (ended_ || hub_.stopping) {
    // To close with unread bytes would reset the connection, and our last words with it.
    while (socket_.read_some(asio::buffer(hub_.scratch), ignored) > 0) {
    }
    return close("parted");
  }
  deadline(hub_.options.limits.farewell);
}

void Connection::close(const char* why) {
  if (closed_) return;
  closed_ = true;
  log_debug("closed " + address_ + ": " + why);
  error_code ignored;
  socket_.close(ignored);
  // Not here and now: it may be in the middle of a fan-out.
  asio::post(hub_.io, [self = shared_from_this()] { self->hub_.remove(*self); });
}

void Connection::arm_read() {
  if (closed_ || ended_ || read_armed_) return;
  if (parting_ ? !parting_->shut : face_->stuck()) return;
  read_armed_ = true;
  if (wire_.pending()) {  // which no socket shows
    return asio::post(hub_.io, [self = shared_from_this()] {
      self->read_armed_ = false;
      if (!self->closed_) self->on_readable();
    });
  }
  socket_.async_wait(Socket::wait_read, [self = shared_from_this()](error_code error) {
    self->read_armed_ = false;
    if (!error && !self->closed_) self->on_readable();
  });
}

// ---- out ----

void Connection::pump() {
  if (closed_ || write_armed_) return;
  written(writer_.write(wire_, outbox_, hub_.clock.now()));
}

void Connection::written(Writer::State state) {
  switch (state) {
    case Writer::State::done:
      return;
    case Writer::State::blocked:
      return arm_write();
    case Writer::State::broken:
      return close("the peer is gone");
  }
}

void Connection::arm_write() {
  write_armed_ = true;
  socket_.async_wait(Socket::wait_write, [self = shared_from_this()](error_code error) {
    self->write_armed_ = false;
    if (!error && !self->closed_) self->update();
  });
}

void Connection::arm_rate() {
  if (closed_ || write_armed_) return;
  const auto due = outbox_.due();
  if (!due || (rate_due_ != 0 && rate_due_ <= *due)) return;
  rate_due_ = *due;
  hub_.wakes.at(*due, weak_from_this());
}

void Connection::wake(Nanoseconds due) {
  if (due == rate_due_) rate_due_ = 0;
  if (due == allowed_) allowed_ = 0;
  update();
}

}  // namespace posed::net
