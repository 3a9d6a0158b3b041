#include "tests/bench/stream/contestants.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "proto/codec.h"
#include "server/net/server.h"

namespace posed::test {
namespace {

constexpr int kSegments = 18;

int tick_timer(double rate_hz) {
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  const long period = static_cast<long>(1e9 / rate_hz);
  const itimerspec every{{period / 1'000'000'000, period % 1'000'000'000}, {0, 1}};
  timerfd_settime(timer, 0, &every, nullptr);
  return timer;
}

void wait_for_tick(int timer) {
  std::uint64_t expired = 0;
  if (read(timer, &expired, sizeof expired) != sizeof expired) throw std::runtime_error("no ticks");
}

// As the daemon's station does: grants subscriptions, encodes each frame once, publishes it. Its thread is another than
// the network's.
void serve_posed(double rate_hz, const std::function<void(std::uint16_t)>& tell_port) {
  const Clock clock;
  net::Server* server = nullptr;
  net::Options options;
  options.port = 0;
  net::Handlers handlers;
  handlers.opened = [](net::ConnectionId, const net::Peer&) {};
  handlers.closed = [](net::ConnectionId) {};
  handlers.line = [&](net::ConnectionId id, const proto::Line& line, Nanoseconds) {
    const auto& request = std::get<proto::Request>(line.entries.at(0));
    const auto& wish = std::get<proto::StreamSubscribe>(request.params);
    server->reply(
        id, std::make_shared<const std::string>(proto::encode_reply(request.id, proto::SubscribeResult{wish.stream})));
    server->subscribe(id, {wish.stream, 0, wish.max_rate_hz, wish.credit, true}, nullptr, 0);
  };
  net::Server made(options, handlers, clock);
  server = &made;
  made.start();
  tell_port(made.port());
  const int timer = tick_timer(rate_hz);
  for (std::uint64_t seq = 1;; ++seq) {
    wait_for_tick(timer);
    const Nanoseconds t_ns = clock.now();
    made.publish(proto::Stream::pose, 0, seq, std::make_shared<const std::string>(pose_frame(seq, monotonic_now())),
                 false, t_ns);
  }
}

// The least that a server can do: it accepts, and sends each frame to each peer. What a peer does not take is lost.
void serve_bare(double rate_hz, const std::function<void(std::uint16_t)>& tell_port) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (bind(listener, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(listener, SOMAXCONN) != 0 ||
      getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("cannot listen");
  tell_port(ntohs(address.sin_port));
  const int timer = tick_timer(rate_hz), epoll = epoll_create1(0);
  for (const int fd : {listener, timer}) {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = fd;
    epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &event);
  }
  std::vector<int> peers;
  std::array<epoll_event, 16> events;
  for (std::uint64_t seq = 1;;) {
    const int count = epoll_wait(epoll, events.data(), static_cast<int>(events.size()), -1);
    for (int i = 0; i < count; ++i) {
      if (events[static_cast<std::size_t>(i)].data.fd == listener) {
        for (int peer; (peer = accept4(listener, nullptr, nullptr, SOCK_NONBLOCK)) >= 0;) {
          const int on = 1;
          setsockopt(peer, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
          peers.push_back(peer);
        }
        continue;
      }
      wait_for_tick(timer);
      const std::string frame = pose_frame(seq++, monotonic_now()) + "\n";
      for (const int peer : peers) {
        if (send(peer, frame.data(), frame.size(), MSG_NOSIGNAL | MSG_DONTWAIT) < 0) continue;
      }
    }
  }
}

// Where a program is, as a shell would find it; brokers live in sbin.
std::string find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(std::string(path ? path : "") + ":/usr/sbin:/sbin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = std::filesystem::path(folder) / name;
    if (!folder.empty() && access(file.c_str(), X_OK) == 0) return file;
  }
  return "";
}

}  // namespace

std::string subscribe_line(int credit, double max_rate_hz) {
  proto::StreamSubscribe wish;
  wish.max_rate_hz = max_rate_hz;
  wish.credit = credit;
  return proto::encode_request(1, wish);
}

std::string pose_frame(std::uint64_t seq, Nanoseconds stamp) {
  proto::PoseData data;
  data.t_ns = stamp;
  data.revision = 42;
  proto::FigurePose& figure = data.figures.emplace_back();
  figure.figure = "body";
  figure.cost = 0.0625;
  for (int i = 0; i < kSegments; ++i) {
    const double turn = 0.1 * (i + 1);
    figure.world_from_segment.push_back({{0.1 * std::sin(3.0 * i), 0.3 * std::cos(5.0 * i), 0.09 * i + 0.0123457},
                                         quat_about(Vec3(0.6, 0.8, 0.0), turn)});
  }
  return proto::encode_pose_frame(seq, data, {true, false, false});
}

Contestant posed_lines() {
  return {"posed/tcp", Framing::lines, subscribe_line(), false, [](double rate_hz) {
            return std::make_unique<Child>([rate_hz](const auto& tell_port) { serve_posed(rate_hz, tell_port); });
          }};
}

Contestant posed_websocket() {
  Contestant contestant = posed_lines();
  contestant.who = "posed/websocket";
  contestant.framing = Framing::websocket;
  return contestant;
}

Contestant posed_capped(double rate_hz) {
  Contestant contestant = posed_lines();
  contestant.who = "posed/tcp capped";
  contestant.subscribe = subscribe_line(0, rate_hz);
  contestant.start = [start = contestant.start](double) { return start(240.0); };
  return contestant;
}

Contestant bare_loop() {
  return {"floor", Framing::lines, "", false, [](double rate_hz) {
            return std::make_unique<Child>([rate_hz](const auto& tell_port) { serve_bare(rate_hz, tell_port); });
          }};
}

std::vector<Contestant> brokers(std::string& missing) {
  std::vector<Contestant> found;
  const auto add = [&](const std::string& name, Framing framing, std::vector<std::string> arguments) {
    const std::string program = find_program(name);
    if (program.empty()) {
      missing += ' ' + name;
      return;
    }
    found.push_back({name, framing, "", true, [program, arguments](double) {
                       const std::uint16_t port = free_port();
                       std::vector<std::string> command{program};
                       command.insert(command.end(), arguments.begin(), arguments.end());
                       command.push_back(std::to_string(port));
                       return std::make_unique<Child>(command, port);
                     }});
  };
  add("nats-server", Framing::nats, {"-a", "127.0.0.1", "-p"});
  add("mosquitto", Framing::mqtt, {"-p"});
  return found;
}

}  // namespace posed::test
