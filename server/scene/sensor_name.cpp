#include "server/scene/sensor_name.h"

#include <charconv>
#include <string_view>

#include "common/names.h"

namespace posed {

Result<SensorName> read_sensor(const std::string& name) {
  SensorName sensor;
  const std::size_t colon = name.rfind(':');
  const char* const end = name.data() + name.size();
  bool good = colon != std::string::npos && valid_id(std::string_view(name).substr(0, colon));
  if (good) {
    const auto parsed = std::from_chars(name.data() + colon + 1, end, sensor.station);
    good = parsed.ec == std::errc{} && parsed.ptr == end && sensor.station >= 1 && sensor.station <= 256;
  }
  if (!good)
    return Error{"unknown_sensor", "a sensor is named DEVICE:STATION", "/sensor",
                 "as in simulated:1; tracker.list names them"};
  sensor.device = name.substr(0, colon);
  return sensor;
}

}  // namespace posed
