#include "server/tracker/frame_assembler.h"

#include <algorithm>
#include <utility>

namespace posed::tracker {

void FrameAssembler::add(Sample sample, Nanoseconds now, std::vector<Frame>& out) {
  if (opens_another_cycle(sample)) {
    highest_ = pending_.samples.back().station;
    close(out);
  }
  if (too_late(sample)) {
    // Its instant is already told: a second Frame of the same instant would show the other sensors as gone.
    closed_station_ = sample.station;
    highest_ = std::max(highest_, sample.station);
    return;
  }
  const auto [last, first_time] = last_rotation_.try_emplace(sample.station, sample.rotation);
  if (!first_time) last->second = sample.rotation = same_sign(last->second, sample.rotation);

  const int station = sample.station;
  pending_.t_ns = now;
  pending_.samples.push_back(sample);
  if (station >= highest_) {
    highest_ = station;
    close(out);
  }
}

bool FrameAssembler::opens_another_cycle(const Sample& sample) const {
  if (pending_.samples.empty()) return false;
  const Sample& last = pending_.samples.back();
  return sample.station <= last.station || (counted_ && sample.device_count != last.device_count);
}

bool FrameAssembler::too_late(const Sample& sample) const {
  if (!pending_.samples.empty() || closed_station_ == 0 || sample.station <= closed_station_) return false;
  return !counted_ || sample.device_count == closed_count_;
}

void FrameAssembler::close(std::vector<Frame>& out) {
  closed_station_ = pending_.samples.back().station;
  closed_count_ = pending_.samples.back().device_count;
  pending_.device = device_;
  out.push_back(std::exchange(pending_, Frame{}));
}

}  // namespace posed::tracker
