#include "server/tracker/capture/replay.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "server/tracker/status_board.h"

namespace posed::tracker {

ReplayTracker::ReplayTracker(CaptureReader reader, bool flat_out, TimeSource now)
    : reader_(std::move(reader)), flat_out_(flat_out), now_(std::move(now)) {}

ReplayTracker::~ReplayTracker() {
  stop();
}

const std::string& ReplayTracker::kind() const {
  static const std::string kind = "replay";
  return kind;
}

void ReplayTracker::start(Sink sink) {
  thread_ = std::thread([this, sink = std::move(sink)]() mutable { run(std::move(sink)); });
}

void ReplayTracker::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void ReplayTracker::run(Sink sink) {
  StatusBoard board(std::move(sink), 0);
  board.set(State::starting, "");
  std::optional<Nanoseconds> shift;  // from the capture's clock to the daemon's
  std::uint64_t bad_bytes = 0;
  for (;;) {
    const auto step = reader_.next();
    if (!step) {
      board.set(State::failed, step.error().message + ": " + step.error().hint);
      return;
    }
    if (step->end) break;
    if (!shift) shift = now_() - step->t_ns;
    const Nanoseconds t_ns = step->t_ns + *shift;
    if (!wait_until(flat_out_ ? 0 : t_ns)) return;
    Heard heard = reader_.feed(*step, t_ns);
    board.add_bad_bytes(reader_.bad_bytes() - std::exchange(bad_bytes, reader_.bad_bytes()));
    if (!heard.frames.empty()) board.set(State::streaming, "");
    for (Frame& frame : heard.frames) board.pass_on(std::move(frame));
    board.tick();
  }
  board.set(State::silent, "the capture has come to its end after " + std::to_string(board.frames()) + " frames");
}

bool ReplayTracker::wait_until(Nanoseconds t_ns) {
  std::unique_lock lock(mutex_);
  for (Nanoseconds left = t_ns - now_(); !stopping_ && left > 0; left = t_ns - now_()) {
    wake_.wait_for(lock, std::chrono::nanoseconds(left));
  }
  return !stopping_;
}

}  // namespace posed::tracker
