#include "server/calibration/apply.h"

#include <array>
#include <charconv>
#include <string_view>

namespace posed::calibration {
namespace {

const SensorCalibration* find(const Calibration& calibration, int station) {
  // Few enough to look through, and without making a string of the number.
  std::array<char, 12> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), station).ptr;
  const std::string_view name(text.data(), static_cast<std::size_t>(end - text.data()));
  for (const auto& [id, sensor] : calibration.sensors) {
    if (id == name) return &sensor;
  }
  return nullptr;
}

}  // namespace

Transform source_from_tip(const Calibration& calibration, int station, const Transform& source_from_sensor) {
  const SensorCalibration* sensor = find(calibration, station);
  if (!sensor) return source_from_sensor;
  Transform tip = source_from_sensor;
  if (sensor->tip) tip.position = source_from_sensor * sensor->tip->offset;
  if (sensor->boresight) tip.rotation = tip.rotation * *sensor->boresight;
  return tip;
}

Transform world_from_tip(const Calibration& calibration, int station, const Transform& source_from_sensor) {
  Transform tip = calibration.world_from_source * source_from_tip(calibration, station, source_from_sensor);
  tip.rotation = glm::normalize(tip.rotation);
  return tip;
}

void apply(const Calibration& calibration, Frame& frame) {
  for (Sample& sample : frame.samples) {
    const Transform tip = world_from_tip(calibration, sample.station, {sample.position, sample.rotation});
    sample.position = tip.position;
    sample.rotation = tip.rotation;
  }
}

}  // namespace posed::calibration
