// Private to the scene: the place of an object or a camera, as an edit says it.
#pragma once

#include <cmath>
#include <string>

#include "common/math.h"
#include "common/result.h"
#include "server/solver/figure_check.h"

namespace posed {

// Within reach, and with a quaternion of unit length to the last digit. Errors: paths "/position/0" and "/quat_xyzw".
inline Status settle_place(Transform& place) {
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(place.position[i]) <= kMaxCoordinate))
      return Error{"out_of_range", "the position is too far away", "/position/" + std::to_string(i),
                   "within 1000 km of the origin"};
  }
  const double length = glm::length(place.rotation);
  if (!(std::abs(length - 1.0) <= kUnitQuatTolerance))
    return Error{"invalid_params", "the quaternion is not of unit length", "/quat_xyzw",
                 "x y z w, with x²+y²+z²+w² = 1"};
  if (std::abs(length - 1.0) > 1e-15) place.rotation = place.rotation / length;  // else kept to the last digit
  return Ok{};
}

}  // namespace posed
