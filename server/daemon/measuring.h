// Listens to sensors for a while, on behalf of who calibrates: the poses as the tracker says them, before any
// calibration. Station loop only.
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <vector>

#include "common/frame.h"
#include "common/result.h"
#include "server/daemon/loop.h"
#include "server/scene/sensor_name.h"

namespace posed {

class Measuring {
 public:
  static constexpr std::size_t kMost = 16;  // at once

  explicit Measuring(Loop& loop) : loop_(loop) {}

  using Done = std::function<void(std::vector<Transform> source_from_sensor)>;
  // `done` is called once, on the loop, when the time is over. Errors: "busy".
  Status begin(SensorName sensor, Nanoseconds duration, Done done);
  void hear(const Frame& frame);

 private:
  struct Measurement {
    SensorName sensor;
    std::vector<Transform> poses;
    Done done;
  };
  Loop& loop_;
  std::list<Measurement> running_;
};

}  // namespace posed
