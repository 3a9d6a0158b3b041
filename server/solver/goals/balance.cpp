#include "server/solver/goals/balance.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace posed::springs {
namespace {

double turn(const Ground& a, const Ground& b, const Ground& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Indices counter-clockwise (Andrew's monotone chain). One or two of them where all points lie on a line.
int hull(std::span<const Ground> points, std::array<int, 2 * kMostSupports>& out) {
  std::array<int, kMostSupports> order{};
  const int n = static_cast<int>(std::min(points.size(), kMostSupports));
  for (int i = 0; i < n; ++i) order[static_cast<std::size_t>(i)] = i;
  const auto at = [&](int i) -> const Ground& { return points[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.begin() + n, [&](int a, int b) {
    return at(a).x != at(b).x ? at(a).x < at(b).x : at(a).y != at(b).y ? at(a).y < at(b).y : a < b;
  });
  int size = 0;
  const auto add = [&](int i, int bottom) {
    while (size >= bottom + 2 && turn(at(out[static_cast<std::size_t>(size - 2)]),
                                      at(out[static_cast<std::size_t>(size - 1)]), at(i)) <= 1e-15) {
      --size;
    }
    out[static_cast<std::size_t>(size++)] = i;
  };
  for (int k = 0; k < n; ++k) add(order[static_cast<std::size_t>(k)], 0);
  const int lower = size - 1;
  for (int k = n - 1; k-- > 0;) add(order[static_cast<std::size_t>(k)], lower);
  return size > 1 ? size - 1 : size;
}

}  // namespace

Footing footing(std::span<const Ground> supports, const Ground& mass, double margin) {
  std::array<int, 2 * kMostSupports> edge{};
  const int n = hull(supports, edge);
  const auto corner = [&](int k) { return supports[static_cast<std::size_t>(edge[static_cast<std::size_t>(k % n)])]; };
  const bool is_area = n > 2;
  bool inside = is_area;
  double nearest = 1e300;
  Footing best;
  Ground middle;
  for (int k = 0; k < n; ++k) middle.x += corner(k).x / n, middle.y += corner(k).y / n;
  double room = 1e300;  // from the middle to the edge
  for (int k = 0; k < std::max(1, is_area ? n : n - 1); ++k) {
    const Ground a = corner(k), b = corner(k + 1);
    const double ex = b.x - a.x, ey = b.y - a.y, length2 = ex * ex + ey * ey;
    const double share =
        length2 > 0.0 ? std::clamp(((mass.x - a.x) * ex + (mass.y - a.y) * ey) / length2, 0.0, 1.0) : 0.0;
    const double dx = mass.x - a.x - share * ex, dy = mass.y - a.y - share * ey;
    const double distance = std::hypot(dx, dy);
    if (turn(a, b, mass) < 0.0) inside = false;
    if (length2 > 0.0) room = std::min(room, turn(a, b, middle) / std::sqrt(length2));
    if (distance >= nearest) continue;
    nearest = distance;
    best.first = edge[static_cast<std::size_t>(k)], best.second = edge[static_cast<std::size_t>((k + 1) % n)];
    best.share = share;
    best.round = share == 0.0 || share == 1.0 ? distance : 0.0;
    if (distance > 1e-12) {
      best.way_x = dx / distance, best.way_y = dy / distance;
    } else if (length2 > 0.0) {
      best.way_x = ey / std::sqrt(length2), best.way_y = -ex / std::sqrt(length2);
      if (inside) best.way_x = -best.way_x, best.way_y = -best.way_y;  // turned again below
    } else {
      best.way_x = 1.0, best.way_y = 0.0;
    }
  }
  if (inside) best.way_x = -best.way_x, best.way_y = -best.way_y;
  best.outside = (inside ? -nearest : nearest) + (is_area ? std::min(margin, 0.9 * room) : 0.0);
  return best;
}

}  // namespace posed::springs
