// Where a centre of mass stands against its support, seen from above.
#pragma once

#include <array>
#include <span>

namespace posed::springs {

struct Ground {
  double x = 0.0, y = 0.0;
};

inline constexpr std::size_t kMostSupports = 64;

struct Footing {
  // An edge of the region moves with two supports: at its place (1 - share) first + share second, along its normal.
  struct Edge {
    int first = 0, second = 0;
    double share = 0.0;
    Ground normal;
    // How much of `way`, and of the level way a quarter turn to its left, its normal makes up.
    double of_way = 0.0, of_left = 0.0;
  };

  double outside = 0.0;             // m; below 0: how far inside
  double way_x = 0.0, way_y = 0.0;  // unit: straight out
  double round = 0.0;               // m, to a corner that is nearest; 0: an edge is
  std::array<Edge, 2> edges;        // of what is nearest; an edge alone is the first
};

// How far `mass` stands outside the region that is left of the convex hull of `supports` (1 to kMostSupports) after its
// edges have moved in by `margin`, or by nine tenths of what they can where the hull is smaller. The edges move in by
// `more` as well (below 0: out); what they can not counts as distance. Points and lines have no room to move in: they
// are their hulls.
Footing footing(std::span<const Ground> supports, const Ground& mass, double margin, double more = 0.0);

}  // namespace posed::springs
