// Where a centre of mass stands against its support, seen from above.
#pragma once

#include <span>

namespace posed::springs {

struct Ground {
  double x = 0.0, y = 0.0;
};

// At most this many support points count.
inline constexpr std::size_t kMostSupports = 16;

struct Footing {
  double outside = 0.0;             // m; below 0: how far inside
  double way_x = 0.0, way_y = 0.0;  // unit: straight out
  // The nearest part of the edge lies between these two supports: (1 - share) first + share second.
  int first = 0, second = 0;
  double share = 0.0;
  double round = 0.0;  // m, to a support that is the nearest part by itself; 0: an edge is
};

// How far `mass` stands outside the convex hull of `supports` (1 to kMostSupports) after its edge has moved in by
// `margin`, or by nine tenths of what it can where the hull is smaller.
Footing footing(std::span<const Ground> supports, const Ground& mass, double margin);

}  // namespace posed::springs
