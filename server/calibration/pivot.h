// Where a stylus's tip is, seen from its sensor: with the tip held in one place the stylus is swung about it, and the
// point of the sensor's frame that moves least is the tip (least squares). Pure.
#pragma once

#include <span>

#include "common/calibration.h"
#include "common/result.h"

namespace posed::calibration {

// `poses`: source_from_sensor. Errors: "invalid_params" where the stylus was not swung about two axes, too few poses.
Result<TipOffset> fit_pivot(std::span<const Transform> poses);

}  // namespace posed::calibration
