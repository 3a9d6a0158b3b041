// A Frame as the wire has it.
#pragma once

#include "common/frame.h"
#include "proto/messages.h"

namespace posed {

inline std::string sensor_id(const std::string& device, int station) {
  return device + ":" + std::to_string(station);
}

inline proto::TrackerData tracker_message(const Frame& frame) {
  proto::TrackerData data;
  data.t_ns = frame.t_ns;
  data.sample_t_ns = frame.sample_t_ns;
  data.device = frame.device;
  for (const Sample& sample : frame.samples) {
    proto::SensorData& sensor = data.sensors.emplace_back();
    sensor.sensor = sensor_id(frame.device, sample.station);
    sensor.position = sample.position;
    sensor.rotation = sample.rotation;
    sensor.buttons = sample.buttons;
    if (sample.flags & kFlagDistorted) sensor.flags.emplace_back("distorted");
    if (sample.flags & kFlagError) sensor.flags.push_back(std::string("error_") + sample.error_letter);
    sensor.device_count = sample.device_count;
    sensor.device_t_ns = sample.device_t_ns;
  }
  return data;
}

}  // namespace posed
