#include "server/net/server.h"

#include <sys/resource.h>

#include <atomic>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <thread>
#include <variant>

#include "server/net/connection.h"
#include "server/net/hub.h"
#include "server/net/listener.h"
#include "server/net/mailbox.h"

namespace posed::net {
namespace {

constexpr auto kSweep = std::chrono::milliseconds(250);  // how exactly deadlines are kept
// So many frames may come up at once without being taken for a backlog. In a backlog newest wins for everyone, so that
// a loop that has fallen behind catches up.
constexpr int kHiccup = 4;

struct Reply {
  ConnectionId connection;
  SharedLine line;
};
struct Notify {
  ConnectionId connection;
  SharedLine line;
};
struct Subscribe {
  ConnectionId connection;
  Subscription subscription;
  SharedLine present;
  std::uint64_t seq;
};
struct Unsubscribe {
  ConnectionId connection;
  proto::Stream stream;
};
struct Publish {
  proto::Stream stream;
  std::uint32_t key;
  std::uint64_t seq;
  SharedLine line;
  bool binary;
  Nanoseconds t_ns;
};
struct Admit {
  ConnectionId connection;
};
struct SetPage {
  std::string path, content_type;
  SharedLine body;
};
struct Stop {};
using Command = std::variant<Reply, Notify, Subscribe, Unsubscribe, Publish, Admit, SetPage, Stop>;

void raise_descriptor_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == limit.rlim_max) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace

struct Server::Impl {
  Impl(Options options, Handlers handlers, const Clock& clock, const boost::asio::ip::tcp::endpoint& endpoint)
      : hub(std::move(options), std::move(handlers), clock, endpoint.address().is_loopback()),
        listener(hub, endpoint),
        sweep_timer(hub.io),
        stop_timer(hub.io) {}

  void post(Command command) {
    if (mailbox.push(std::move(command))) boost::asio::post(hub.io, [this] { take_mail(); });
  }

  Connection* find(ConnectionId id) {
    const auto found = hub.connections.find(id);
    return found == hub.connections.end() ? nullptr : found->second.get();
  }

  // One update for all that a connection is told at once.
  void update_later(Connection& connection) {
    if (connection.mark_dirty()) dirty.push_back(connection.shared_from_this());
  }

  void take_mail() {
    mailbox.take(commands);
    int frames = 0;
    for (const Command& command : commands) frames += std::holds_alternative<Publish>(command);
    backlog = frames > kHiccup;
    for (Command& command : commands) std::visit([this](auto& c) { take(c); }, command);
    commands.clear();
    for (std::size_t i = 0; i < dirty.size(); ++i) {
      dirty[i]->clear_dirty();
      dirty[i]->update();
    }
    dirty.clear();
  }

  void take(Reply& c) {
    Connection* const connection = find(c.connection);
    if (!connection) return;
    connection->reply(c.line);
    update_later(*connection);
  }
  void take(Notify& c) {
    Connection* const connection = find(c.connection);
    if (!connection) return;
    connection->notify(c.line);
    update_later(*connection);
  }
  void take(Subscribe& c) {
    Connection* const connection = find(c.connection);
    if (!connection) return;
    connection->subscribe(c.subscription, c.present ? StreamFrame(*c.present, c.subscription.binary) : StreamFrame(),
                          c.seq);
    update_later(*connection);
  }
  void take(Unsubscribe& c) {
    Connection* const connection = find(c.connection);
    if (!connection) return;
    connection->unsubscribe(c.stream);
    update_later(*connection);
  }
  void take(Publish& c) {
    const StreamFrame frame(*c.line, c.binary, c.t_ns);
    const Nanoseconds now = hub.clock.now();
    hub.subscriptions.for_each(c.stream, c.key, [&](Connection& connection) {
      connection.publish(c.stream, c.seq, frame, now, !backlog);
      if (backlog) update_later(connection);
    });
  }
  void take(Admit& c) {
    if (Connection* const connection = find(c.connection)) connection->admit();
  }
  void take(SetPage& c) { hub.site.set_page(std::move(c.path), std::move(c.content_type), std::move(c.body)); }
  void take(Stop&);

  void sweep() {
    sweep_timer.expires_after(kSweep);
    sweep_timer.async_wait([this](boost::system::error_code error) {
      if (error) return;
      const Nanoseconds now = hub.clock.now();
      for (const auto& [id, connection] : hub.connections) connection->check(now);
      sweep();
    });
  }

  Hub hub;
  Listener listener;
  Mailbox<Command> mailbox;
  std::vector<Command> commands;
  std::vector<std::shared_ptr<Connection>> dirty;
  bool backlog = false;
  boost::asio::steady_timer sweep_timer, stop_timer;
  std::thread thread;
};

void Server::Impl::take(Stop&) {
  hub.stopping = true;
  listener.stop();
  for (const auto& [id, connection] : hub.connections) {
    connection->part_now();
    update_later(*connection);
  }
  if (hub.connections.empty()) return hub.io.stop();
  stop_timer.expires_after(std::chrono::nanoseconds(hub.options.limits.stop));
  stop_timer.async_wait([this](boost::system::error_code error) {
    if (error) return;
    for (const auto& [id, connection] : hub.connections) connection->close("the server stops");
  });
}

Server::Server(Options options, Handlers handlers, const Clock& clock) {
  raise_descriptor_limit();
  const auto endpoint = endpoint_of(options.host, options.port);
  impl_ = std::make_unique<Impl>(std::move(options), std::move(handlers), clock, endpoint);
}

Server::~Server() {
  stop();
}

std::uint16_t Server::port() const {
  return impl_->listener.port();
}

void Server::start() {
  impl_->listener.start();
  impl_->sweep();
  impl_->thread = std::thread([impl = impl_.get()] { impl->hub.io.run(); });
}

void Server::stop() {
  if (!impl_->thread.joinable()) return;
  impl_->post(Stop{});
  impl_->thread.join();
}

void Server::reply(ConnectionId connection, SharedLine line) {
  impl_->post(Reply{connection, std::move(line)});
}

void Server::notify(ConnectionId connection, SharedLine line) {
  impl_->post(Notify{connection, std::move(line)});
}

void Server::subscribe(ConnectionId connection, Subscription subscription, SharedLine present, std::uint64_t seq) {
  impl_->post(Subscribe{connection, subscription, std::move(present), seq});
}

void Server::unsubscribe(ConnectionId connection, proto::Stream stream) {
  impl_->post(Unsubscribe{connection, stream});
}

void Server::publish(proto::Stream stream, std::uint32_t key, std::uint64_t seq, SharedLine line, bool binary,
                     Nanoseconds t_ns) {
  impl_->post(Publish{stream, key, seq, std::move(line), binary, t_ns});
}

void Server::admit(ConnectionId connection) {
  impl_->post(Admit{connection});
}

void Server::set_page(std::string path, std::string content_type, SharedLine body) {
  impl_->post(SetPage{std::move(path), std::move(content_type), std::move(body)});
}

Counters Server::counters() const {
  return impl_->hub.tally.read();
}

}  // namespace posed::net
