#include "server/daemon/measuring.h"

namespace posed {

Status Measuring::begin(SensorName sensor, Nanoseconds duration, Done done) {
  if (running_.size() >= kMost)
    return Error{"busy", "sensors are being measured for too many already", "", "wait until one is done"};
  const auto here = running_.insert(running_.end(), {std::move(sensor), {}, std::move(done)});
  loop_.after(duration, [this, here] {
    Measurement over = std::move(*here);
    running_.erase(here);
    over.done(std::move(over.poses));
  });
  return Ok{};
}

void Measuring::hear(const Frame& frame) {
  for (Measurement& m : running_) {
    if (m.sensor.device != frame.device) continue;
    for (const Sample& sample : frame.samples) {
      if (sample.station == m.sensor.station) m.poses.push_back({sample.position, sample.rotation});
    }
  }
}

}  // namespace posed
