// The rigid motion that takes points of a tracker's source to the points of the world that were touched: least squares
// over three points or more (Horn, "Closed-form solution of absolute orientation using unit quaternions", 1987). Pure.
#pragma once

#include <vector>

#include "common/calibration.h"
#include "common/result.h"

namespace posed::calibration {

struct RigidFit {
  Transform world_from_source;
  std::vector<AlignedPoint> points;  // as given, with their residuals, m
  double residual_m = 0.0;           // root mean square
};

// Errors, with paths "/points" or "/points/2/world": fewer than three points, points that coincide or lie on a line,
// numbers that are no places.
Result<RigidFit> fit_rigid(std::vector<AlignedPoint> points);

}  // namespace posed::calibration
