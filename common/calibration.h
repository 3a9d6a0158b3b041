// What has been measured of a tracker where it stands: where its source is in the world, and how each sensor lies on
// what it is fixed to. Plain values; the device itself is told nothing of it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/math.h"

namespace posed {

// A known point of the world that was touched.
struct AlignedPoint {
  Vec3 source{0.0, 0.0, 0.0};  // where the tracker had it, source's frame, m
  Vec3 world{0.0, 0.0, 0.0};
  double residual_m = 0.0;  // left between the two; 0 of a point that is not fitted yet
};

// By pivoting about a fixed point.
struct TipOffset {
  Vec3 offset{0.0, 0.0, 0.0};  // sensor's frame, m
  double residual_m = 0.0;     // root mean square of how far the tip went from the point; 0 where the offset was given
  int samples = 0;             // 0: the offset was given
};

struct SensorCalibration {
  std::optional<TipOffset> tip;
  std::optional<Quat> boresight;  // sensor_from_boresight: turns what is measured to what was wanted
};

struct Calibration {
  std::string tracker, name;
  std::int64_t utc_ns = 0;  // when it was last measured
  std::string author;
  Transform world_from_source;
  double residual_m = 0.0;  // root mean square over the points
  std::vector<AlignedPoint> points;
  std::map<std::string, SensorCalibration> sensors;  // by station, "1"
};

}  // namespace posed
