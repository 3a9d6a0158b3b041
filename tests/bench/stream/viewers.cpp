#include "tests/bench/stream/viewers.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

#include "tests/bench/stream/child.h"

namespace posed::test {
namespace {

constexpr std::uint64_t kTimer = UINT64_MAX, kPublisher = UINT64_MAX - 1;

void no_waiting(int fd) {
  fcntl(fd, F_SETFL, O_NONBLOCK);
}

}  // namespace

void send_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) throw std::runtime_error("a server takes no bytes");
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

int connect_to(std::uint16_t port) {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (fd < 0 || connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("cannot connect");
  const int on = 1;
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return fd;
}

double Arrived::quantile_us(double p) {
  if (ages_us.empty()) return 0.0;
  if (!std::is_sorted(ages_us.begin(), ages_us.end())) std::sort(ages_us.begin(), ages_us.end());
  return ages_us[static_cast<std::size_t>(p * static_cast<double>(ages_us.size() - 1))];
}

Viewers::Viewers(std::uint16_t port, Framing framing, const std::string& subscribe, int count, const std::string& first)
    : framing_(framing), epoll_(epoll_create1(0)), buffer_(256 << 10) {
  for (int i = 0; i < count; ++i) {
    Viewer& viewer = viewers_.emplace_back();
    const std::string& request = i == 0 && !first.empty() ? first : subscribe;
    viewer.fd = connect_to(port);
    send_all(viewer.fd, greeting(framing, request));
    if (framing == Framing::websocket) {
      char byte[512];
      for (std::string answer; !answer.ends_with("\r\n\r\n");) {
        const ssize_t got = recv(viewer.fd, byte, sizeof byte, 0);
        if (got <= 0) throw std::runtime_error("no WebSocket there");
        answer.append(byte, static_cast<std::size_t>(got));
      }
      send_all(viewer.fd, websocket_text(request));
    }
    no_waiting(viewer.fd);
    add(viewer.fd, static_cast<std::uint64_t>(i));
  }
}

Viewers::~Viewers() {
  for (const Viewer& viewer : viewers_) close(viewer.fd);
  for (const int fd : {epoll_, timer_, publisher_}) {
    if (fd >= 0) close(fd);
  }
}

void Viewers::add(int fd, std::uint64_t tag) const {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = tag;
  epoll_ctl(epoll_, EPOLL_CTL_ADD, fd, &event);
}

void Viewers::publish(double rate_hz, std::function<std::string(Nanoseconds)> frame) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getpeername(viewers_.front().fd, reinterpret_cast<sockaddr*>(&address), &size);
  publisher_ = connect_to(ntohs(address.sin_port));
  send_all(publisher_, publisher_greeting(framing_));
  no_waiting(publisher_);
  frame_ = std::move(frame);
  timer_ = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK);
  const long period = static_cast<long>(1e9 / rate_hz);
  const itimerspec every{{period / 1'000'000'000, period % 1'000'000'000}, {0, 1}};
  timerfd_settime(timer_, 0, &every, nullptr);
  add(timer_, kTimer);
  add(publisher_, kPublisher);
}

void Viewers::publish_due() {
  std::uint64_t expired = 0;
  if (read(timer_, &expired, sizeof expired) != sizeof expired) return;
  const std::string bytes = published(framing_, frame_(monotonic_now()));
  // A broker that takes no more is a broker that drops: what is under way is finished, the rest of the tick is lost.
  std::string_view left = bytes;
  while (!left.empty()) {
    const ssize_t sent = send(publisher_, left.data(), left.size(), MSG_NOSIGNAL);
    if (sent < 0 && left.size() == bytes.size()) return;
    if (sent > 0) left.remove_prefix(static_cast<std::size_t>(sent));
  }
}

Arrived Viewers::read_until(Nanoseconds until, int apart) {
  Arrived arrived;
  std::array<epoll_event, 512> events;
  for (Nanoseconds now = monotonic_now(); now < until; now = monotonic_now()) {
    const int left_ms = static_cast<int>(std::min<Nanoseconds>((until - now) / 1'000'000 + 1, 100));
    const int count = epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), left_ms);
    for (int i = 0; i < count; ++i) {
      const std::uint64_t tag = events[static_cast<std::size_t>(i)].data.u64;
      if (tag == kTimer) {
        publish_due();
      } else if (tag == kPublisher) {
        const ssize_t got = recv(publisher_, buffer_.data(), buffer_.size(), 0);
        if (got > 0 && std::string_view(buffer_.data(), static_cast<std::size_t>(got)).starts_with("PING"))
          send_all(publisher_, pong(framing_));
      } else {
        drain(tag, static_cast<int>(tag) == apart ? nullptr : &arrived);
      }
    }
  }
  return arrived;
}

void Viewers::drain(std::size_t index, Arrived* arrived) {
  Viewer& viewer = viewers_[index];
  const ssize_t got = recv(viewer.fd, buffer_.data(), buffer_.size(), 0);
  if (got == 0 || (got < 0 && errno != EAGAIN)) {
    ++closed_;
    epoll_ctl(epoll_, EPOLL_CTL_DEL, viewer.fd, nullptr);
    return;
  }
  if (got < 0) return;
  if (arrived) arrived->bytes += static_cast<std::uint64_t>(got);
  std::string_view bytes(buffer_.data(), static_cast<std::size_t>(got));
  std::string joined;
  if (!viewer.rest.empty()) {
    joined = std::move(viewer.rest.append(bytes));
    bytes = joined;
  }
  while (!bytes.empty()) {
    const Piece piece = cut(framing_, bytes);
    if (piece.size == 0) break;
    take(viewer, index, piece, arrived);
    bytes.remove_prefix(piece.size);
  }
  viewer.rest = std::string(bytes);
}

void Viewers::take(Viewer& viewer, std::size_t index, const Piece& piece, Arrived* arrived) {
  if (piece.ping) send_all(viewer.fd, pong(framing_));
  const auto stamp = stamp_of(piece.payload);
  if (!stamp) return;
  if (arrived) {
    ++arrived->frames;
    arrived->ages_us.push_back(1e-3f * static_cast<float>(monotonic_now() + clock_offset_ - *stamp));
  }
  if (!acks_ || index != 0) return;
  first_stamps_.push_back(*stamp);
  const std::size_t at = piece.payload.find("\"seq\":") + 6;
  std::uint64_t seq = 0;
  std::from_chars(piece.payload.data() + at, piece.payload.data() + piece.payload.size(), seq);
  const std::string ack =
      R"({"jsonrpc":"2.0","method":"stream.ack","params":{"stream":"pose","seq":)" + std::to_string(seq) + "}}";
  send_all(viewer.fd, framing_ == Framing::websocket ? websocket_text(ack) : ack + "\n");
}

void Viewers::stall(bool stalls) {
  if (stalls) {
    epoll_ctl(epoll_, EPOLL_CTL_DEL, viewers_.front().fd, nullptr);
  } else {
    add(viewers_.front().fd, 0);
  }
}

int Viewers::stale_frames(Nanoseconds moment) {
  const auto count =
      std::count_if(first_stamps_.begin(), first_stamps_.end(), [&](Nanoseconds t) { return t < moment; });
  first_stamps_.clear();
  return static_cast<int>(count);
}

}  // namespace posed::test
