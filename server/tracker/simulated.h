// A tracker that needs no hardware: two sensors that swing smoothly, within reach of the tempus figure's hands (station
// 1 before the right one, station 2 before the left). The same seed and tick give the same samples.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "server/tracker/time_source.h"
#include "server/tracker/tracker.h"

namespace posed::tracker {

struct SimulatedOptions {
  std::string id = "simulated";
  std::uint64_t seed = 1;
  int stations = 2;   // odd ones swing on the right, even ones on the left
  int rate_hz = 240;  // 1..1000
};

// The frame of tick `count`; pure. t_ns is 0: the caller's to set. World axes, m.
Frame simulated_frame(const SimulatedOptions& options, std::uint64_t count);

class SimulatedTracker final : public Tracker {
 public:
  SimulatedTracker(SimulatedOptions options, TimeSource now);
  ~SimulatedTracker() override;

  const std::string& id() const override { return options_.id; }
  const std::string& kind() const override;
  void start(Sink sink) override;
  void stop() override;

 private:
  void run(Sink sink);

  SimulatedOptions options_;
  TimeSource now_;
  std::mutex mutex_;  // of stopping_
  std::condition_variable wake_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace posed::tracker
