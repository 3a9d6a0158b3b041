// A sensor that is held still for a while: the mean of what it said. Pure.
#pragma once

#include <span>

#include "common/math.h"

namespace posed::calibration {

struct Still {
  Transform mean;
  double spread_m = 0.0;  // root mean square of the positions about their mean
};

// At least one pose. The mean turn is the one nearest to all (Markley et al., "Averaging quaternions", 2007).
Still average(std::span<const Transform> poses);

}  // namespace posed::calibration
