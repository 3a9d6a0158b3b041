// What a tracker's own thread tells of itself: passes a Status on when its state or message changes, and about once a
// second. One thread.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "common/frame.h"
#include "server/tracker/tracker.h"

namespace posed::tracker {

class StatusBoard {
 public:
  StatusBoard(Sink sink, double rate_hz);

  void set(State state, std::string message);
  void set_rate(double hz) { status_.rate_hz = hz; }
  void pass_on(Frame frame);  // counts it first
  void add_bad_bytes(std::uint64_t count) { status_.bad_bytes += count; }
  void tick();  // call often: says the once-a-second status where it is due
  State state() const { return status_.state; }
  std::uint64_t frames() const { return status_.frames; }

 private:
  void tell();

  Sink sink_;
  Status status_;
  std::chrono::steady_clock::time_point told_{};
};

}  // namespace posed::tracker
