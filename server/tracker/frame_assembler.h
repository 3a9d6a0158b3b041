// Gathers the samples of one instant into a Frame. A Frame closes at the last station that is known to be active, not
// with the next cycle, so that no Frame waits. Who is active is learnt as it goes: a last station that vanishes delays
// one Frame by one cycle; one that joins is heard from its second cycle on. Pure; one thread.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/frame.h"

namespace posed::tracker {

class FrameAssembler {
 public:
  // `counted`: the samples carry the device's frame count, which tells cycles apart.
  FrameAssembler(std::string device, bool counted) : device_(std::move(device)), counted_(counted) {}

  void expect_up_to(int station) { highest_ = station; }  // as the device lists its active stations; 0: not known
  // Takes the next sample in the device's order (ascending stations within a cycle), which arrived at `now` on the
  // daemon's clock; appends the Frames that it completes. A Frame's t_ns is the arrival of its last sample. Rotations
  // come out sign-continuous a station.
  void add(Sample sample, Nanoseconds now, std::vector<Frame>& out);

 private:
  bool opens_another_cycle(const Sample& sample) const;
  bool too_late(const Sample& sample) const;
  void close(std::vector<Frame>& out);

  std::string device_;
  bool counted_;
  int highest_ = 0;
  Frame pending_;
  int closed_station_ = 0;  // the last one of the Frame that was closed last; 0: none yet
  std::uint32_t closed_count_ = 0;
  std::map<int, Quat> last_rotation_;
};

}  // namespace posed::tracker
