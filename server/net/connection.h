// One socket: reads into its face, writes from its outbox, and knows when to close. Network thread only.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/net/detect.h"
#include "server/net/face.h"
#include "server/net/hub.h"
#include "server/net/outbox.h"
#include "server/net/wire.h"
#include "server/net/writer.h"

namespace posed::net {

class Connection final : public Link, public std::enable_shared_from_this<Connection> {
 public:
  using Socket = boost::asio::ip::tcp::socket;

  // `address` is the whole of it, as text; `remote` without its port.
  Connection(Hub& hub, Socket socket, ConnectionId id, std::string address, boost::asio::ip::address remote);
  ~Connection();

  void start();
  // These only queue: call update() when all that is known was said.
  void reply(const SharedLine& line);
  void notify(const SharedLine& line);
  void subscribe(const Subscription& subscription, const StreamFrame& present, std::uint64_t seq);
  void unsubscribe(proto::Stream stream);
  // Puts a frame into the outbox; with `send` on the wire, if it may go.
  void publish(proto::Stream stream, std::uint64_t seq, const StreamFrame& frame, Nanoseconds now, bool send);
  void flush();
  // The moment that it waited for.
  void wake(Nanoseconds due);
  // Sends what may go, reads what there is room for, closes if all is done.
  void update();
  void admit() { admitted_ = true; }
  void part_now();
  // Now and then: deadlines, heartbeats, and whether the peer takes what it is owed.
  void check(Nanoseconds now);
  void close(const char* why);

  ConnectionId id() const { return id_; }
  const boost::asio::ip::address& remote() const { return remote_; }
  bool opened() const { return opened_; }
  // Marks it for an update. True the first time.
  bool mark_dirty() { return !std::exchange(dirty_, true); }
  void clear_dirty() { dirty_ = false; }

  bool room() const override;
  bool idle() const override { return writer_.idle() && outbox_.replies() == 0; }
  bool may_ask() override { return hub_.guests.may_ask(remote_, hub_.clock.now()); }
  void hand_up(std::string_view line) override;
  void send(SharedLine bytes) override { outbox_.send(std::move(bytes), Framing::raw); }
  void open(bool websocket) override;
  void become(std::unique_ptr<Face> face, std::string_view rest) override;
  void deadline(Nanoseconds in) override { deadline_ = in > 0 ? hub_.clock.now() + in : 0; }
  void part(std::uint16_t close_code, std::optional<Error> last_words, Owed owed) override;

 private:
  struct Parting {
    std::uint16_t close_code = 0;
    std::optional<Error> last_words;
    bool waits = false;  // for replies that are owed
    bool said = false;   // all that there is to say is queued
    bool shut = false;   // and sent: now the peer may close
  };

  std::unique_ptr<Face> make_face(Detected detected);
  bool sniff();
  bool plain_refused(Detected detected);
  void tls_refused();
  void refill(Nanoseconds now);
  void overflow();
  void check_heartbeat(Nanoseconds now);
  void check_reading(Nanoseconds now);
  void on_readable();
  void on_end();
  void pump();
  void written(Writer::State state);
  void say_goodbye();
  void close_if_done();
  void arm_read();
  void arm_write();
  void arm_rate();
  void arm_allowance();

  Hub& hub_;
  Socket socket_;
  const ConnectionId id_;
  const std::string address_;
  const boost::asio::ip::address remote_;
  Wire wire_;
  Outbox outbox_;
  Writer writer_;
  std::unique_ptr<Face> face_;
  std::vector<std::unique_ptr<Face>> retired_;  // may still be on the stack
  std::optional<Parting> parting_;
  Nanoseconds receive_t_ns_ = 0;
  Nanoseconds rate_due_ = 0;     // when the hub wakes us; 0: it does not
  Nanoseconds deadline_ = 0;     // 0: none
  Nanoseconds since_ = 0;        // when it came, or began to speak the protocol
  Nanoseconds heard_ = 0;        // when bytes last came
  Nanoseconds pinged_ = 0;       // when we last asked for some; 0: not since
  Nanoseconds stuck_since_ = 0;  // when it last took bytes of what it is owed; 0: it is owed nothing
  std::uint64_t stuck_at_ = 0;   // how many it had taken then
  std::size_t unanswered_ = 0;   // lines that were handed up
  std::size_t expected_reply_;   // bytes, of those that are owed
  bool opened_ = false, closed_ = false, ended_ = false;
  bool sniffed_ = false, admitted_ = false;
  double allowance_ = 0.0;    // lines that it may still send, where there is a limit
  Nanoseconds refilled_ = 0;  // when that was so
  Nanoseconds allowed_ = 0;   // when the hub wakes us to read on; 0: it does not
  bool read_armed_ = false, write_armed_ = false, small_buffer_ = false;
  bool dirty_ = false;
};

}  // namespace posed::net
