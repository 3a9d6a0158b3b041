// All that Frames say, as text to be compared: numbers to their last bit.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "common/frame.h"

namespace posed::test {

// Times are told from `origin` on.
inline std::string frames_text(const std::vector<Frame>& frames, Nanoseconds origin) {
  std::string all;
  for (const Frame& frame : frames) {
    all += frame.device + " " + std::to_string(frame.t_ns - origin);
    for (const Sample& s : frame.samples) {
      char line[400];
      std::snprintf(line, sizeof line, " %d %a %a %a %a %a %a %a %u %u %d %u %lld;", s.station, s.position.x,
                    s.position.y, s.position.z, s.rotation.x, s.rotation.y, s.rotation.z, s.rotation.w, s.buttons,
                    s.flags, s.error_letter, s.device_count, static_cast<long long>(s.device_t_ns));
      all += line;
    }
    all += "\n";
  }
  return all;
}

}  // namespace posed::test
