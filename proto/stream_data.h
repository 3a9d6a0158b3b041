// What the streams carry, of PROTOCOL.md. What a field means, and its units, stands there.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "common/scene.h"
#include "common/time.h"
#include "proto/results.h"

namespace posed::proto {

struct PoseFields {
  bool world_from_segment = true, q = true, goals = true, objects = true;
  bool operator<(const PoseFields& o) const {
    return std::tie(world_from_segment, q, goals, objects) < std::tie(o.world_from_segment, o.q, o.goals, o.objects);
  }
  bool operator==(const PoseFields&) const = default;
};
struct ObjectFrame {
  std::string object;
  Transform world_from_object;
};
struct PoseData {
  Nanoseconds t_ns = 0;
  std::uint64_t revision = 0;
  std::vector<FigurePose> figures;
  std::vector<ObjectFrame> objects = {};  // those that sensors lead
};
struct SensorData {
  std::string sensor;
  Vec3 position{0.0, 0.0, 0.0};
  Quat rotation{1.0, 0.0, 0.0, 0.0};
  std::uint32_t buttons = 0;
  std::vector<std::string> flags;
  std::uint32_t device_count = 0;
  Nanoseconds device_t_ns = 0;
};
struct CameraFrame {
  std::string camera;
  Transform world_from_camera;
  double fov_y = kDefaultFovY;
  bool operator==(const CameraFrame& o) const {
    return camera == o.camera && world_from_camera.position == o.world_from_camera.position &&
           world_from_camera.rotation == o.world_from_camera.rotation && fov_y == o.fov_y;
  }
};
struct CameraData {
  Nanoseconds t_ns = 0;
  std::vector<CameraFrame> cameras;
};
struct TrackerData {
  Nanoseconds t_ns = 0;
  Nanoseconds sample_t_ns = 0;  // 0: not known
  std::string device;
  std::vector<SensorData> sensors;
};
// Of the last second. Lag: how long after it was measured, as the device's count tells, a sample has come at most;
// jitter: root mean square of how unevenly they came.
struct TrackerStats {
  std::string tracker;
  double rate_hz = 0.0, jitter_us = 0.0, lag_us = 0.0;
};
struct StatsData {
  Nanoseconds t_ns = 0;
  std::uint64_t frames = 0, solves = 0;
  double solve_us = 0.0;           // median of the last second
  double sample_to_send_us = 0.0;  // median of the last second, from the bytes' arrival to the encoded line
  int connections = 0;
  std::uint64_t dropped = 0;
  // Of pose and tracker frames in the last second, from the sample's arrival until the kernel has taken the frame, and
  // until a viewer with credit has acknowledged it. 0: there were none.
  double frame_age_us = 0.0, frame_age_p99_us = 0.0, acked_age_us = 0.0, acked_age_p99_us = 0.0;
  std::vector<TrackerStats> trackers = {};
};

}  // namespace posed::proto
