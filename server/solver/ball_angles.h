// A ball joint's turn as the three angles that its box of limits is about (common/figure.h: Joint::limits).
#pragma once

#include <array>

#include "common/math.h"

namespace posed {

struct AngleRange {
  double min = -M_PI, max = M_PI;
};

// The angle, moved by whole turns to where it lies in the range, or nearest to its middle. An open range leaves it
// alone.
double near_range(double angle, const AngleRange& range);

// Cosine of y below which x and z are one angle.
inline constexpr double kQuarterTurn = 1e-9;

// The tangents, as y[k] over x[k], of x, y, z of R = Rx(x) Ry(y) Rz(z), with y within a quarter turn; x[1] is the
// cosine of y. Below kQuarterTurn they say nothing about x and z.
void ball_tangents(const Quat& turn, double* y, double* x);
// Of those angles (three) and the other triple that means the same turn the one that is nearer to the ranges.
void choose_triple(const std::array<AngleRange, 3>& ranges, double* angles);

// x, y, z of R = Rx(x) Ry(y) Rz(z), rad. Of the two triples that there are, the one that is nearer to the ranges; where
// y is a quarter turn, so that only the sum or difference of x and z is known, a split that lies in the ranges if any
// does.
std::array<double, 3> ball_angles(const Quat& turn, const std::array<AngleRange, 3>& ranges);

}  // namespace posed
