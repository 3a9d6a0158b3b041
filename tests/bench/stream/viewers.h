// The load: many viewers of one stream on one thread, and for a broker the publisher beside them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/stream/framings.h"

namespace posed::test {

// What arrived between two moments.
struct Arrived {
  std::uint64_t frames = 0, bytes = 0;  // bytes with their framing
  std::vector<float> ages_us;           // from a frame's stamp to its last byte here

  double quantile_us(double p);  // sorts
};

int connect_to(std::uint16_t port);  // throws std::runtime_error
void send_all(int fd, std::string_view bytes);

class Viewers {
 public:
  // Connects them all. `subscribe` is a request of posed's; brokers and the bare loop need none. Viewer 0 may have
  // another.
  Viewers(std::uint16_t port, Framing framing, const std::string& subscribe, int count, const std::string& first = "");
  ~Viewers();
  Viewers(const Viewers&) = delete;
  Viewers& operator=(const Viewers&) = delete;

  // What a server's clock is ahead of ours, where its stamps are of its own clock.
  void set_clock_offset(Nanoseconds offset) { clock_offset_ = offset; }
  // From now on `frame` goes to the broker so many times a second.
  void publish(double rate_hz, std::function<std::string(Nanoseconds stamp)> frame);
  // Reads what comes until then. Frames of viewer `apart` are left out.
  Arrived read_until(Nanoseconds until, int apart = -1);

  // Viewer 0 reads no more, or again. It acknowledges frames if `acks`.
  void stall(bool stalls);
  void acknowledge() { acks_ = true; }
  // The frames that viewer 0 had to read since the last call, with stamps from before `moment`.
  int stale_frames(Nanoseconds moment);
  int closed() const { return closed_; }

 private:
  struct Viewer {
    int fd = -1;
    std::string rest;  // of a frame that is not whole
  };

  void drain(std::size_t index, Arrived* arrived);
  void take(Viewer& viewer, std::size_t index, const Piece& piece, Arrived* arrived);
  void publish_due();
  void add(int fd, std::uint64_t tag) const;

  Framing framing_;
  int epoll_ = -1, timer_ = -1, publisher_ = -1;
  std::function<std::string(Nanoseconds)> frame_;
  std::vector<Viewer> viewers_;
  std::vector<char> buffer_;
  std::vector<Nanoseconds> first_stamps_;  // of viewer 0, if it is watched
  Nanoseconds clock_offset_ = 0;
  bool acks_ = false;
  int closed_ = 0;
};

}  // namespace posed::test
