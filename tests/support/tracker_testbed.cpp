#include "tests/support/tracker_testbed.h"

#include <algorithm>
#include <chrono>

namespace posed::test {

TrackerTestbed::~TrackerTestbed() {
  end();
}

void TrackerTestbed::begin() {
  ticker_ = std::thread([this] { run(); });
}

void TrackerTestbed::end() {
  stopping_ = true;
  if (ticker_.joinable()) ticker_.join();
}

void TrackerTestbed::with_tracker(const std::function<void(TrackerEmulator&)>& act) {
  const std::lock_guard lock(mutex_);
  act(*device_);
}

bool TrackerTestbed::streaming() {
  bool answer = false;
  with_tracker([&](TrackerEmulator& device) { answer = device.streaming(); });
  return answer;
}

void TrackerTestbed::run() {
  using namespace std::chrono;
  const auto begun = steady_clock::now();
  const auto period = nanoseconds(1'000'000'000 / device_->rate_hz());
  for (long n = 1; !stopping_; ++n) {
    // Small steps: answers must not wait for the next cycle.
    while (steady_clock::now() < begun + n * period && !stopping_) {
      std::this_thread::sleep_until(std::min(begun + n * period, steady_clock::now() + milliseconds(1)));
      listen();
      deliver();
    }
    with_tracker([](TrackerEmulator& device) { device.tick(); });
    deliver();
  }
}

void TrackerTestbed::deliver() {
  if (!ready()) return;
  std::deque<TrackerEmulator::Output> outputs;
  with_tracker([&](TrackerEmulator& device) { outputs = device.drain(); });
  for (const auto& output : outputs) {
    const std::size_t piece = piece_ ? piece_.load() : output.bytes.size();
    for (std::size_t at = 0; at < output.bytes.size(); at += piece) {
      const auto begin = output.bytes.begin() + static_cast<std::ptrdiff_t>(at);
      const auto size = static_cast<std::ptrdiff_t>(std::min(piece, output.bytes.size() - at));
      carry({{begin, begin + size}, output.cycle});
    }
  }
}

}  // namespace posed::test
