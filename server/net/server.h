// The network loop: one thread that owns all sockets. It knows requests, replies and lines of streams, and nothing of
// what they are about.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/time.h"
#include "proto/messages.h"
#include "server/net/subscription.h"
#include "server/net/tally.h"
#include "server/net/tls.h"
#include "server/net/tokens.h"

namespace posed::net {

struct Limits {
  std::size_t connections = 10'000;
  std::size_t connections_per_address = 0;  // 0: as many as there may be
  double lines_per_second = 0.0;            // of one peer; further ones stay unread for as long; 0: no limit
  double handshakes_per_second = 0.0;       // of TLS, of one address; with more it is closed; 0: no limit
  double http_requests_per_second = 0.0;    // of one address; with more it is told so and closed; 0: no limit
  std::size_t unanswered = 256;             // lines of one peer; further ones stay unread until some are answered
  std::size_t unread_bytes = 256 << 10;     // of replies to one peer; with more nothing is read from it
  std::size_t replies = 10'000;             // queued for one peer; with more it is told so and closed
  std::size_t reply_bytes = 4 << 20;        // the same, in bytes
  std::size_t line_bytes = proto::kMaxLineBytes;
  int subscriber_send_buffer = 64 << 10;      // bytes; what the kernel holds for a subscriber is the past
  Nanoseconds http_request = 10'000'000'000;  // from the first byte of a request to the end of its header
  Nanoseconds http_reply = 60'000'000'000;    // to take one reply, or between two requests
  Nanoseconds admission = 0;                  // in which a peer has to be admitted; 0: it need not be
  Nanoseconds heartbeat = 20'000'000'000;  // of silence, after which a WebSocket is asked for a pong; 3: it is closed
  Nanoseconds unread_reply = 30'000'000'000;  // in which a peer takes no byte of what it is owed
  Nanoseconds farewell = 2'000'000'000;       // to read the last words of a connection that we close
  Nanoseconds stop = 1'000'000'000;           // to read what is queued when the server stops
};

struct Options {
  std::string host = "127.0.0.1";
  std::uint16_t port = proto::kDefaultPort;  // 0: any free one
  std::filesystem::path viewer;              // served at "/"; empty or absent: a page that says how to build it
  std::vector<std::string> hosts;            // names besides the machine's own by which browsers may call us
  std::vector<std::string> origins;          // pages of other hosts that may connect: "http://localhost:5173"
  std::shared_ptr<const Tokens> tokens;      // none: the pages of set_page are everybody's
  std::shared_ptr<const TlsContext> tls;     // none: no TLS
  bool plain_on_loopback = true;             // with TLS, peers on this machine may go without
  Limits limits;
};

struct Peer {
  std::string address;  // "127.0.0.1:51234"
  bool websocket = false;
};

// Called on the network thread; must not block. A peer is opened once it is known to speak the protocol (a visitor who
// only fetches pages never is), and closed exactly once.
struct Handlers {
  std::function<void(ConnectionId, Peer)> opened;
  std::function<void(ConnectionId)> closed;
  // Each line is answered by exactly one reply(). Of stream.ack only requests with an id are left in it: the credit is
  // already booked, and they want an empty result.
  std::function<void(ConnectionId, proto::Line, Nanoseconds receive_t_ns)> line;
};

class Server {
 public:
  // Binds and listens; throws std::runtime_error with one sentence that names the cure. `clock` outlives the server.
  Server(Options options, Handlers handlers, const Clock& clock);
  ~Server();  // stops

  std::uint16_t port() const;
  void start();
  // Takes no more connections and lines, sends the replies that were given before the call (at most Limits::stop long),
  // closes, and waits until all that is done. Further calls do nothing. Not from a handler.
  void stop();

  // From any thread; done in the order of the calls. A connection that is gone is no error.
  void reply(ConnectionId connection, SharedLine line);  // null: this line is answered with nothing
  // What a request has asked to be told on the way to its reply. Left out where something else waits to be sent.
  void notify(ConnectionId connection, SharedLine line);
  // `present` (may be null) is the first frame. Call it after the reply that grants it.
  void subscribe(ConnectionId connection, Subscription subscription, SharedLine present, std::uint64_t seq);
  void unsubscribe(ConnectionId connection, proto::Stream stream);
  // To all subscriptions of this stream and key. `seq` ascends within a stream. `binary` as in the subscriptions.
  // `t_ns` is the time of what the frame tells, for the count of ages; 0: none.
  void publish(proto::Stream stream, std::uint32_t key, std::uint64_t seq, SharedLine line, bool binary = false,
               Nanoseconds t_ns = 0);
  // The peer has shown who it is: it may stay.
  void admit(ConnectionId connection);
  void set_page(std::string path, std::string content_type, SharedLine body);  // path as in "/metrics"

  Counters counters() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace posed::net
