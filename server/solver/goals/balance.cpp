#include "server/solver/goals/balance.h"

#include <algorithm>
#include <cmath>

namespace posed::springs {
namespace {

constexpr double kNothing = 1e-12;  // m

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}
double dot(const Ground& a, const Ground& b) {
  return a.x * b.x + a.y * b.y;
}
double cross(const Ground& a, const Ground& b) {
  return a.x * b.y - a.y * b.x;
}
Ground minus(const Ground& a, const Ground& b) {
  return {a.x - b.x, a.y - b.y};
}
double length_of(const Ground& a) {
  return std::sqrt(dot(a, a));
}
Ground between(const Ground& a, const Ground& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}
double share_of(const Ground& p, const Ground& a, const Ground& b) {
  const Ground e = minus(b, a);
  const double length2 = dot(e, e);
  return length2 > 0.0 ? dot(minus(p, a), e) / length2 : 0.0;
}

// Indices counter-clockwise (Andrew's monotone chain). One or two of them where all points lie on a line.
int hull(std::span<const Ground> points, std::array<int, 2 * kMostSupports>& out) {
  std::array<int, kMostSupports> order;
  const int n = static_cast<int>(std::min(points.size(), kMostSupports));
  for (int i = 0; i < n; ++i) order[at(i)] = i;
  const auto point = [&](int i) -> const Ground& { return points[at(i)]; };
  std::sort(order.begin(), order.begin() + n, [&](int a, int b) {
    return point(a).x != point(b).x   ? point(a).x < point(b).x
           : point(a).y != point(b).y ? point(a).y < point(b).y
                                      : a < b;
  });
  int size = 0;
  const auto add = [&](int i, int bottom) {
    while (size >= bottom + 2 && cross(minus(point(out[at(size - 1)]), point(out[at(size - 2)])),
                                       minus(point(i), point(out[at(size - 2)]))) <= 1e-15) {
      --size;
    }
    out[at(size++)] = i;
  };
  for (int k = 0; k < n; ++k) add(order[at(k)], 0);
  const int lower = size - 1;
  for (int k = n - 1; k-- > 0;) add(order[at(k)], lower);
  return size > 1 ? size - 1 : size;
}

// A line or a point that is stood on.
Footing on_line(std::span<const Ground> supports, int first, int second, const Ground& mass) {
  const Ground &a = supports[at(first)], &b = supports[at(second)];
  const double share = std::clamp(share_of(mass, a, b), 0.0, 1.0);
  const Ground apart = minus(mass, between(a, b, share)), line = minus(b, a);
  Footing out;
  out.outside = length_of(apart);
  const double length = length_of(line);
  if (out.outside > kNothing)
    out.way_x = apart.x / out.outside, out.way_y = apart.y / out.outside;
  else if (length > 0.0)
    out.way_x = line.y / length, out.way_y = -line.x / length;
  else
    out.way_x = 1.0;
  const bool corner = share == 0.0 || share == 1.0;
  if (!corner) {
    out.edges[0] = {first, second, share, {out.way_x, out.way_y}, 1.0, 0.0};
    return out;
  }
  out.round = out.outside;
  const int support = share == 0.0 ? first : second;
  out.edges[0] = {support, support, 0.0, {1.0, 0.0}, out.way_x, -out.way_y};
  out.edges[1] = {support, support, 0.0, {0.0, 1.0}, out.way_y, out.way_x};
  return out;
}

// What all edges of the hull leave of the ground after they have moved in. Memory has no values by default: most of it
// is never used.
class Region {
 public:
  // A hull of three corners or more.
  Region(std::span<const Ground> supports, std::span<const int> hull)
      : supports_(supports), hull_(hull), sides_(static_cast<int>(hull.size())) {
    for (int k = 0; k < sides_; ++k) {
      const Ground e = minus(second(k), first(k));
      const double length = length_of(e);
      normals_[at(k)] = {e.y / length, -e.x / length};
    }
  }

  // What its edges can move in by.
  double room() const {
    Place middle{0.0, 0.0};
    for (int k = 0; k < sides_; ++k) middle.x += first(k).x / sides_, middle.y += first(k).y / sides_;
    double room = 1e300;
    for (int k = 0; k < sides_; ++k) room = std::min(room, -beyond(k, {middle.x, middle.y}));
    return room;
  }

  Footing stand(const Ground& mass, double moved) const {
    int side = 0;
    double most = -1e300;
    for (int k = 0; k < sides_; ++k) {
      const double over = beyond(k, mass) + moved;
      if (over > most) most = over, side = k;
    }
    return most <= 0.0 ? stand_at_side(side, mass, most) : stand_outside(mass, moved);
  }

 private:
  struct Place {
    double x, y;
  };
  struct Corner {  // where an edge begins
    double x, y;
    int side;
    Ground place() const { return {x, y}; }
  };
  using Corners = std::array<Corner, 2 * kMostSupports>;

  const Ground& first(int side) const { return supports_[at(hull_[at(side)])]; }
  const Ground& second(int side) const { return supports_[at(hull_[at(side + 1 < sides_ ? side + 1 : 0)])]; }
  Ground normal(int side) const { return {normals_[at(side)].x, normals_[at(side)].y}; }
  double beyond(int side, const Ground& p) const { return dot(minus(p, first(side)), normal(side)); }

  Footing::Edge edge_at(int side, const Ground& place) const {
    Footing::Edge out;
    out.first = hull_[at(side)], out.second = hull_[at(side + 1 < sides_ ? side + 1 : 0)];
    out.share = share_of(place, first(side), second(side));
    out.normal = normal(side);
    return out;
  }

  Footing stand_at_side(int side, const Ground& mass, double outside) const {
    Footing out;
    out.outside = outside;
    out.way_x = normal(side).x, out.way_y = normal(side).y;
    out.edges[0] = edge_at(side, mass);
    out.edges[0].of_way = 1.0;
    return out;
  }

  Footing stand_outside(const Ground& mass, double moved) const {
    Corners some, others;
    Corners *corners = &some, *cut = &others;
    int n = sides_;
    for (int k = 0; k < n; ++k) some[at(k)] = {first(k).x, first(k).y, k};
    for (int k = 0; moved > 0.0 && k < sides_; ++k) {
      const int left = leave(k, -moved, {corners->data(), at(n)}, *cut);
      if (left < 3) break;  // too thin for its numbers
      n = left;
      std::swap(corners, cut);
    }
    double nearest = 1e300, share = 0.0;
    int edge = 0;
    const auto next = [&](int k) -> const Corner& { return (*corners)[at(k + 1 < n ? k + 1 : 0)]; };
    for (int k = 0; k < n; ++k) {
      const Ground a = (*corners)[at(k)].place(), b = next(k).place();
      const double s = std::clamp(share_of(mass, a, b), 0.0, 1.0);
      const double distance = length_of(minus(mass, between(a, b, s)));
      if (distance < nearest) nearest = distance, edge = k, share = s;
    }
    const Corner& from = (*corners)[at(edge)];
    if (share > 0.0 && share < 1.0) return stand_at_side(from.side, mass, nearest);
    if (share == 1.0) return stand_at_corner(from.side, next(edge), mass, nearest);
    return stand_at_corner((*corners)[at(edge > 0 ? edge - 1 : n - 1)].side, from, mass, nearest);
  }

  // Of a convex region what is not farther out than `limit` beyond a side; returns its corners.
  int leave(int side, double limit, std::span<const Corner> corners, Corners& left) const {
    int n = 0;
    const Corner* a = &corners.back();
    double over = beyond(side, a->place()) - limit;
    for (const Corner& b : corners) {
      const double next = beyond(side, b.place()) - limit;
      if ((over <= 0.0) != (next <= 0.0)) {
        // The way out begins the new edge, the way back goes on along the old one.
        const Ground place = between(a->place(), b.place(), over / (over - next));
        left[at(n++)] = {place.x, place.y, over <= 0.0 ? side : a->side};
      }
      if (next <= 0.0) left[at(n++)] = b;
      a = &b, over = next;
    }
    return n;
  }

  // Where the edge of `before` meets that which begins at `corner`.
  Footing stand_at_corner(int before, const Corner& corner, const Ground& mass, double distance) const {
    const Ground a = normal(before), b = normal(corner.side);
    const double turn = cross(a, b);
    if (distance <= kNothing || std::abs(turn) < 1e-9) return stand_at_side(before, mass, distance);
    const Ground apart = minus(mass, corner.place()), way{apart.x / distance, apart.y / distance}, left{-way.y, way.x};
    Footing out;
    out.outside = out.round = distance;
    out.way_x = way.x, out.way_y = way.y;
    out.edges = {edge_at(before, corner.place()), edge_at(corner.side, corner.place())};
    out.edges[0].of_way = cross(way, b) / turn, out.edges[1].of_way = cross(a, way) / turn;
    out.edges[0].of_left = cross(left, b) / turn, out.edges[1].of_left = cross(a, left) / turn;
    return out;
  }

  std::span<const Ground> supports_;
  std::span<const int> hull_;
  int sides_;
  std::array<Place, kMostSupports> normals_;
};

}  // namespace

Footing footing(std::span<const Ground> supports, const Ground& mass, double margin, double more) {
  std::array<int, 2 * kMostSupports> corners;
  const int n = hull(supports, corners);
  if (n < 3) {
    Footing out = on_line(supports, corners[0], corners[at(n - 1)], mass);
    out.outside += more;
    return out;
  }
  Region region(supports, {corners.data(), at(n)});
  const double most = 0.9 * region.room(), wished = std::min(margin, most) + more,
               moved = std::clamp(wished, 0.0, most);
  Footing out = region.stand(mass, moved);
  out.outside += wished - moved;
  return out;
}

}  // namespace posed::springs
