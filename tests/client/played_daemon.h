// A daemon played by a script: listens on a free port, takes one connection after another, and answers each line as a
// function says.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "proto/codec.h"

namespace posed::client::test {

class PlayedDaemon {
 public:
  // Gives the lines to send, each with its end; "close" closes the connection.
  using Answer = std::function<std::vector<std::string>(const proto::Request&)>;

  explicit PlayedDaemon(Answer answer) : answer_(std::move(answer)) {
    listener_ = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    ::listen(listener_, 16);
    socklen_t size = sizeof address;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~PlayedDaemon() {
    ::shutdown(listener_, SHUT_RDWR);
    {
      const std::lock_guard lock(mutex_);
      if (peer_ >= 0) ::shutdown(peer_, SHUT_RDWR);
    }
    thread_.join();
    ::close(listener_);
  }

  std::string address() const { return "tcp://127.0.0.1:" + std::to_string(port_); }
  std::vector<std::string> lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

 private:
  void run() {
    for (;;) {
      const int peer = ::accept(listener_, nullptr, nullptr);
      if (peer < 0) return;
      {
        const std::lock_guard lock(mutex_);
        peer_ = peer;
      }
      serve(peer);
      const std::lock_guard lock(mutex_);
      ::close(std::exchange(peer_, -1));
    }
  }

  void serve(int peer) {
    std::string buffer;
    for (;;) {
      char chunk[4096];
      const ssize_t got = ::recv(peer, chunk, sizeof chunk, 0);
      if (got <= 0) return;
      buffer.append(chunk, static_cast<std::size_t>(got));
      for (std::size_t end; (end = buffer.find('\n')) != std::string::npos; buffer.erase(0, end + 1)) {
        const std::string text = buffer.substr(0, end);
        {
          const std::lock_guard lock(mutex_);
          lines_.push_back(text);
        }
        const proto::Line line = proto::decode_line(text);
        const auto* request = line.entries.empty() ? nullptr : std::get_if<proto::Request>(&line.entries.front());
        if (!request) return;
        for (const std::string& reply : answer_(*request)) {
          if (reply == "close") return;
          ::send(peer, reply.data(), reply.size(), MSG_NOSIGNAL);
        }
      }
    }
  }

  Answer answer_;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  mutable std::mutex mutex_;
  int peer_ = -1;
  std::vector<std::string> lines_;
  std::thread thread_;
};

inline std::string stats_frame(std::uint64_t seq) {
  proto::StatsData data;
  data.frames = seq;
  return proto::encode_stats_frame(seq, data) + "\n";
}

template <class R>
std::vector<std::string> reply(const proto::Request& request, const R& result) {
  return {proto::encode_reply(request.id, result) + "\n"};
}

// A free port on which nothing listens.
inline std::string nobody() {
  const PlayedDaemon gone([](const proto::Request&) { return std::vector<std::string>{}; });
  return gone.address();
}

}  // namespace posed::client::test
