#include "server/tracker/simulated.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "server/tracker/status_board.h"

namespace posed::tracker {
namespace {

constexpr Nanoseconds kSecond = 1'000'000'000;

// The middle and the reach of the swing on the right; the left mirrors it in Y.
constexpr Vec3 kMiddle{0.45, -0.25, 1.20};
constexpr Vec3 kReach{0.10, 0.20, 0.30};
constexpr Vec3 kTurn{0.5, 0.6, 0.8};  // rad, about X, Y and Z

// splitmix64: the standard's distributions differ between libraries, and a seed must mean the same everywhere.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  double between(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53; }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

Vec3 swing(Dice& dice, double seconds) {
  Vec3 v;
  for (int axis = 0; axis < 3; ++axis) {
    const double hz = dice.between(0.05, 0.25);
    const double phase = dice.between(0.0, 2.0 * std::numbers::pi);
    v[axis] = std::sin(2.0 * std::numbers::pi * hz * seconds + phase);
  }
  return v;
}

Nanoseconds time_of_tick(std::uint64_t count, int rate_hz) {
  const auto n = static_cast<std::int64_t>(count);
  return n / rate_hz * kSecond + n % rate_hz * kSecond / rate_hz;
}

std::uint64_t last_tick_before(Nanoseconds t, int rate_hz) {
  return static_cast<std::uint64_t>(t / kSecond * rate_hz + t % kSecond * rate_hz / kSecond);
}

}  // namespace

Frame simulated_frame(const SimulatedOptions& options, std::uint64_t count) {
  const Nanoseconds t = time_of_tick(count, options.rate_hz);
  const double seconds = static_cast<double>(t) * 1e-9;
  Frame frame;
  frame.device = options.id;
  for (int station = 1; station <= options.stations; ++station) {
    Dice dice(options.seed * 1000003u + static_cast<std::uint64_t>(station));
    Sample sample;
    sample.station = station;
    sample.position = kMiddle + kReach * swing(dice, seconds);
    if (station % 2 == 0) sample.position.y = -sample.position.y;
    const Vec3 turn = kTurn * swing(dice, seconds);
    sample.rotation = quat_about(kZ, turn.z) * quat_about(kY, turn.y) * quat_about(kX, turn.x);
    sample.device_count = static_cast<std::uint32_t>(count);
    sample.device_t_ns = t;
    frame.samples.push_back(sample);
  }
  return frame;
}

SimulatedTracker::SimulatedTracker(SimulatedOptions options, TimeSource now)
    : options_(std::move(options)), now_(std::move(now)) {}

SimulatedTracker::~SimulatedTracker() {
  stop();
}

const std::string& SimulatedTracker::kind() const {
  static const std::string kind = "simulated";
  return kind;
}

void SimulatedTracker::start(Sink sink) {
  thread_ = std::thread([this, sink = std::move(sink)]() mutable { run(std::move(sink)); });
}

void SimulatedTracker::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void SimulatedTracker::run(Sink sink) {
  StatusBoard board(std::move(sink), options_.rate_hz);
  board.set(State::streaming, "");
  const Nanoseconds start = now_();
  std::uint64_t tick = 0;
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const Nanoseconds deadline = start + time_of_tick(tick, options_.rate_hz);
    const Nanoseconds now = now_();
    if (now < deadline) {
      wake_.wait_for(lock, std::chrono::nanoseconds(deadline - now));
      continue;
    }
    // Late by more than a tick: the ticks between are gone, as they would be on a device.
    tick = std::max(tick, last_tick_before(now - start, options_.rate_hz));
    lock.unlock();
    Frame frame = simulated_frame(options_, tick);
    frame.t_ns = now;
    board.pass_on(std::move(frame));
    board.tick();
    lock.lock();
    ++tick;
  }
}

}  // namespace posed::tracker
