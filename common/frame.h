// What a tracker hands up: a Frame is one instant of all active sensors. A sensor that is missing is absent, never
// zero.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/math.h"
#include "common/time.h"

namespace posed {

// Sample::flags
inline constexpr std::uint32_t kFlagDistorted = 1u << 0;  // the device says that metal bends its field here
inline constexpr std::uint32_t kFlagError = 1u << 1;  // the device put an error letter on this record, in error_letter

struct Sample {
  int station = 1;                    // 1-based, as on the device; the sensor's id is DEVICE:STATION
  Vec3 position{0.0, 0.0, 0.0};       // metres, world axes, origin at the source
  Quat rotation{1.0, 0.0, 0.0, 0.0};  // world_from_sensor
  std::uint32_t buttons = 0;          // bit 0 is the first button
  std::uint32_t flags = 0;
  char error_letter = 0;
  std::uint32_t device_count = 0;  // the device's own frame counter
  Nanoseconds device_t_ns = 0;     // the device's own clock
};

struct Frame {
  Nanoseconds t_ns = 0;         // daemon clock, where the bytes arrived
  Nanoseconds sample_t_ns = 0;  // daemon clock, when it was measured as the device counts; 0: not known
  std::string device;           // "liberty", "simulated"
  std::vector<Sample> samples;  // ascending stations, each at most once
};

}  // namespace posed
