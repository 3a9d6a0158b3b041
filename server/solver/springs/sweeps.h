// What runs over a whole figure before and after a solve, for the instruction set of this machine. Arrays of angles
// have room for whole vectors: padded(n) numbers; what lies beyond n is overwritten.
#pragma once

#include <cstddef>
#include <span>

#include "server/solver/body_tree.h"

namespace posed::springs {

inline constexpr std::size_t padded(std::size_t n) {
  return (n + 7) / 8 * 8;
}

// angle[i] = atan2(y[i], x[i]), rad; 0 where both are 0. To 4 ulp.
void arc_tangents(const double* y, const double* x, std::size_t n, double* angle);

// Sine and cosine of half of each angle, rad.
void half_sines(const double* angle, std::size_t n, double* sine, double* cosine);

// The same as forward_kinematics (solver/kinematics.h).
void place_segments(const BodyTree& tree, std::span<const double> q, std::span<Transform> world_from_segment);

}  // namespace posed::springs
