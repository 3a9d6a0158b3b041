// A server with a station that answers by rule, and a peer on a plain socket to talk to it.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "proto/codec.h"
#include "server/net/server.h"

namespace posed::net::test {

// Waits for what another thread brings about. Tests fail by this alone if it never comes.
inline bool eventually(const std::function<bool()>& condition) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

// Patient: no test shall fail because the machine is busy.
inline Options options_on_a_free_port() {
  Options options;
  options.port = 0;
  options.limits.http_request = options.limits.http_reply = options.limits.farewell = options.limits.stop =
      60'000'000'000;
  return options;
}

inline SharedLine share(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

// Answers session.ping with the receive stamp, session.status with a reply of `padding` bytes and more, subscribes and
// unsubscribes as asked, and answers everything else with an empty result.
class FakeStation {
 public:
  explicit FakeStation(Options options = options_on_a_free_port(), bool start = true)
      : server(std::move(options),
               {[this](ConnectionId id, Peer peer) { on_opened(id, std::move(peer)); },
                [this](ConnectionId id) { on_closed(id); },
                [this](ConnectionId id, proto::Line line, Nanoseconds t_ns) { on_line(id, line, t_ns); }},
               clock) {
    if (start) server.start();
  }
  ~FakeStation() { server.stop(); }

  // While held, lines are counted but not answered.
  void hold() {
    const std::lock_guard lock(mutex);
    held = true;
  }
  void release() {
    const std::lock_guard lock(mutex);
    held = false;
    for (const auto& [id, line] : waiting) server.reply(id, line);
    waiting.clear();
  }
  std::size_t waiting_lines() {
    const std::lock_guard lock(mutex);
    return waiting.size();
  }
  std::map<ConnectionId, Peer> open_peers() {
    const std::lock_guard lock(mutex);
    return peers;
  }

  // A frame of the stats stream with its seq and `size` bytes to carry.
  static SharedLine frame(std::uint64_t seq, std::size_t size = 0, proto::Stream stream = proto::Stream::stats) {
    return share(R"({"jsonrpc":"2.0","method":"stream.frame","params":{"stream":")" +
                 std::string(proto::stream_name(stream)) + R"(","seq":)" + std::to_string(seq) + R"(,"data":{"x":")" +
                 std::string(size, 'x') + "\"}}}");
  }
  void publish(std::uint64_t seq, std::size_t size = 0, proto::Stream stream = proto::Stream::stats) {
    server.publish(stream, 0, seq, frame(seq, size, stream));
  }

  std::size_t padding = 0;
  Clock clock;
  std::mutex mutex;
  bool held = false;
  std::vector<std::pair<ConnectionId, SharedLine>> waiting;
  std::map<ConnectionId, Peer> peers;
  int opened = 0, closed = 0, lines = 0;
  Server server;

 private:
  void on_opened(ConnectionId id, Peer peer) {
    const std::lock_guard lock(mutex);
    ++opened;
    peers[id] = std::move(peer);
  }
  void on_closed(ConnectionId id) {
    const std::lock_guard lock(mutex);
    ++closed;
    EXPECT_EQ(peers.erase(id), 1u);
  }

  void on_line(ConnectionId id, const proto::Line& line, Nanoseconds t_ns) {
    std::vector<std::string> replies;
    std::vector<std::function<void()>> after;
    for (const auto& entry : line.entries) {
      if (const auto* bad = std::get_if<proto::BadRequest>(&entry)) {
        replies.push_back(proto::encode_error(bad->id, bad->error));
        continue;
      }
      const auto& request = std::get<proto::Request>(entry);
      std::string text = answer(id, request, t_ns, after);
      if (!request.id.empty()) replies.push_back(std::move(text));
    }
    std::string text = line.batch ? proto::join_batch(replies) : replies.empty() ? "" : replies.front();
    SharedLine reply = text.empty() ? nullptr : share(std::move(text));
    {
      const std::lock_guard lock(mutex);
      ++lines;
      if (held) {
        waiting.emplace_back(id, reply);
      } else {
        server.reply(id, reply);
      }
    }
    for (const auto& act : after) act();
  }

  std::string answer(ConnectionId id, const proto::Request& request, Nanoseconds t_ns,
                     std::vector<std::function<void()>>& after) {
    if (const auto* wish = std::get_if<proto::StreamSubscribe>(&request.params)) {
      const bool binary = wish->encoding == proto::Encoding::cbor;
      const Subscription subscription{
          wish->stream, binary ? 1u : 0u, wish->max_rate_hz, wish->credit, wish->stream != proto::Stream::scene,
          binary};
      after.push_back(
          [this, id, subscription] { server.subscribe(id, subscription, frame(0, 0, subscription.stream), 0); });
      return proto::encode_reply(request.id, proto::SubscribeResult{wish->stream});
    }
    if (const auto* wish = std::get_if<proto::StreamUnsubscribe>(&request.params)) {
      server.unsubscribe(id, wish->stream);
      return proto::encode_reply(request.id, proto::SubscribeResult{wish->stream});
    }
    if (std::get_if<proto::SessionPing>(&request.params)) {
      return proto::encode_reply(request.id, proto::PingResult{t_ns, t_ns});
    }
    if (std::get_if<proto::SessionStatus>(&request.params)) {
      proto::StatusResult result;
      result.daemon = {"fake", std::string(padding, 'x')};
      return proto::encode_reply(request.id, result);
    }
    return proto::encode_reply(request.id, proto::EmptyResult{});
  }
};

// A blocking socket with a long time-out.
class RawPeer {
 public:
  explicit RawPeer(std::uint16_t port, int receive_buffer = 0) {
    fd_ = ::socket(AF_INET, SOCK_STREAM, 0);
    if (receive_buffer > 0) ::setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    const timeval patience{60, 0};
    ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ::setsockopt(fd_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawPeer() { close(); }
  RawPeer(RawPeer&& o) noexcept
      : fd_(std::exchange(o.fd_, -1)), connected_(o.connected_), buffer_(std::move(o.buffer_)) {}
  RawPeer(const RawPeer&) = delete;

  bool connected() const { return connected_; }
  int fd() const { return fd_; }

  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  void end() { ::shutdown(fd_, SHUT_WR); }
  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }
  // Closes so that the other side gets a reset.
  void reset() {
    const linger at_once{1, 0};
    ::setsockopt(fd_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    close();
  }

  // Without its end; nothing if the connection ends (or the time-out is over).
  std::optional<std::string> line() {
    for (;;) {
      const std::size_t end = buffer_.find('\n', scanned_);
      if (end != std::string::npos) {
        std::string text = buffer_.substr(0, end);
        buffer_.erase(0, end + 1);
        scanned_ = 0;
        return text;
      }
      scanned_ = buffer_.size();
      if (!fill()) return std::nullopt;
    }
  }
  // All bytes to the end of the connection.
  std::string rest() {
    while (fill()) {
    }
    return std::exchange(buffer_, {});
  }
  // Bytes up to and with `mark`.
  std::string until(std::string_view mark) {
    std::size_t at;
    while ((at = buffer_.find(mark)) == std::string::npos) {
      if (!fill()) return std::exchange(buffer_, {});
    }
    std::string text = buffer_.substr(0, at + mark.size());
    buffer_.erase(0, text.size());
    return text;
  }
  std::string bytes(std::size_t size) {
    while (buffer_.size() < size && fill()) {
    }
    std::string text = buffer_.substr(0, size);
    buffer_.erase(0, text.size());
    return text;
  }
  bool at_end() { return buffer_.empty() && !fill(); }

  proto::Incoming incoming() {
    const auto text = line();
    EXPECT_TRUE(text) << "the connection ended";
    if (!text) return {};
    auto incoming = proto::decode_incoming(*text);
    EXPECT_TRUE(incoming) << *text;
    return incoming ? *incoming : proto::Incoming{};
  }
  // Skips what is no reply.
  proto::Incoming reply() {
    for (;;) {
      auto incoming = this->incoming();
      if (incoming.id || incoming.error || incoming.method.empty()) return incoming;
    }
  }
  proto::Incoming call(const proto::Params& params, std::int64_t id = 1) {
    send(proto::encode_request(id, params) + "\n");
    return reply();
  }
  // Subscribes and reads the reply and the first frame.
  void follow(const proto::StreamSubscribe& wish) {
    EXPECT_FALSE(call(wish).error);
    EXPECT_EQ(incoming().method, "stream.frame");
  }

 private:
  bool fill() {
    char chunk[65536];
    const ssize_t got = ::recv(fd_, chunk, sizeof chunk, 0);
    if (got <= 0) return false;
    buffer_.append(chunk, static_cast<std::size_t>(got));
    return true;
  }

  int fd_ = -1;
  bool connected_ = false;
  std::string buffer_;
  std::size_t scanned_ = 0;
};

inline std::string ping(int id) {
  return proto::encode_request(id, proto::SessionPing{}) + "\n";
}

}  // namespace posed::net::test
