// DEVICE:STATION, the id of a tracker's sensor.
#pragma once

#include <string>

#include "common/result.h"

namespace posed {

struct SensorName {
  std::string device;
  int station = 0;
  bool operator==(const SensorName&) const = default;
};

// Errors: "unknown_sensor", with path "/sensor".
Result<SensorName> read_sensor(const std::string& name);

}  // namespace posed
