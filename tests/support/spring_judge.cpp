#include "tests/support/spring_judge.h"

#include <algorithm>
#include <cmath>

#include "server/solver/kinematics.h"

namespace posed::test {
namespace {

constexpr double kStep = 1e-6;
constexpr double kNoPull = 1e-6;  // m; differences can not tell less where an error begins to count
constexpr double kAtBound = 1e-6;

using Worlds = std::vector<std::vector<Transform>>;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

double square(double x) {
  return x * x;
}

double angle_of(const Quat& r) {
  return 2.0 * std::atan2(glm::length(Vec3(r.x, r.y, r.z)), std::abs(r.w));
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

Worlds place(const Figures& figures, const AllQ& q) {
  Worlds worlds;
  for (std::size_t f = 0; f < figures.size(); ++f) {
    worlds.emplace_back(at(figures[f]->size()));
    forward_kinematics(*figures[f], q[f], worlds.back());
  }
  return worlds;
}

// Seen from above, a half-plane: what is at most `most` along `way`.
struct Half {
  glm::dvec2 way;
  double most;
};

// Of the hull of points: of each line through two of them that has all others on one side.
std::vector<Half> sides_of(const std::vector<Vec3>& points) {
  std::vector<Half> sides;
  for (const Vec3& a : points) {
    for (const Vec3& b : points) {
      const glm::dvec2 way(b.y - a.y, a.x - b.x);
      if (glm::length(way) < 1e-12) continue;
      const Half half{glm::normalize(way), glm::dot(glm::dvec2(a), glm::normalize(way))};
      const auto beyond = [&](const Vec3& p) { return glm::dot(glm::dvec2(p), half.way) > half.most + 1e-12; };
      if (std::none_of(points.begin(), points.end(), beyond)) sides.push_back(half);
    }
  }
  return sides;
}

// Distance from the points that all halves hold; of points on a line from the nearest of them. By trial: the nearest
// place is on one side, or where two of them meet.
double outside_of(const std::vector<Half>& sides, const glm::dvec2& mass) {
  const auto holds = [&](const glm::dvec2& p) {
    return std::all_of(sides.begin(), sides.end(), [&](const Half& s) { return glm::dot(p, s.way) <= s.most + 1e-9; });
  };
  if (holds(mass)) return 0.0;
  double least = 1e300;
  const auto try_place = [&](const glm::dvec2& p) {
    if (holds(p)) least = std::min(least, glm::length(mass - p));
  };
  for (const Half& a : sides) {
    try_place(mass - a.way * (glm::dot(mass, a.way) - a.most));
    for (const Half& b : sides) {
      const double turn = a.way.x * b.way.y - a.way.y * b.way.x;
      if (std::abs(turn) < 1e-9) continue;
      try_place(glm::dvec2(a.most * b.way.y - b.most * a.way.y, b.most * a.way.x - a.most * b.way.x) / turn);
    }
  }
  return least;
}

double outside_of(const std::vector<Vec3>& points, const glm::dvec2& mass, double margin) {
  std::vector<Half> sides = sides_of(points);
  // A line has two sides that are one, and its ends have none.
  const bool line = std::any_of(sides.begin(), sides.end(), [&](const Half& a) {
    return std::any_of(sides.begin(), sides.end(), [&](const Half& b) {
      return glm::dot(a.way, b.way) < -1.0 + 1e-12 && std::abs(a.most + b.most) < 1e-9;
    });
  });
  if (sides.empty()) return glm::length(mass - glm::dvec2(points[0]));
  if (line) {
    double least = 1e300;
    for (const Vec3& a : points) {
      for (const Vec3& b : points) {
        const glm::dvec2 from(a), along = glm::dvec2(b) - from;
        const double length2 = std::max(glm::dot(along, along), 1e-300);
        const double share = std::clamp(glm::dot(mass - from, along) / length2, 0.0, 1.0);
        least = std::min(least, glm::length(mass - from - along * share));
      }
    }
    return least;
  }
  for (Half& side : sides) side.most -= margin;
  return outside_of(sides, mass);
}

double balance_error(const BodyTree& tree, const BalanceSpring& balance, const std::vector<Transform>& world) {
  Vec3 mass = kZero;
  double kg = 0.0;
  for (int i = 0; i < tree.size(); ++i) {
    mass += tree.segment(i).mass * (world[at(i)] * (0.5 * tree.segment(i).touch_point));
    kg += tree.segment(i).mass;
  }
  std::vector<Vec3> points;
  for (const AttachedPoint& p : balance.support) points.push_back(world[at(p.segment)] * p.point);
  return outside_of(points, glm::dvec2(mass / kg), balance.margin);
}

double posture_error2(const BodyTree& tree, const PostureSpring& posture, const std::vector<double>& q) {
  double sum = 0.0;
  const double lever = tree.document().lever;
  std::vector<double> wanted = q;
  std::size_t next = 0;
  for (const int j : posture.joints) {
    const auto size = at(q_size(tree.joint(j).type)), first = at(tree.q_at(j));
    std::copy_n(posture.values.begin() + static_cast<std::ptrdiff_t>(next), size,
                wanted.begin() + static_cast<std::ptrdiff_t>(first));
    next += size;
    const auto is = spans(tree, q, j), should = spans(tree, wanted, j);
    if (tree.joint(j).type == JointType::prismatic) {
      sum += square(is[0].value - should[0].value);
    } else if (!is.empty() && !is_limb(tree.joint(j))) {
      for (std::size_t k = 0; k < is.size(); ++k) sum += square(lever * (is[k].value - should[k].value));
    } else if (size >= 4) {
      const auto turn = [&](const std::vector<double>& from) {
        return quat_from_xyzw(std::span<const double>(from).subspan(first + size - 4, 4));
      };
      sum += square(lever * angle_of(turn(q) * glm::conjugate(turn(wanted))));
      for (std::size_t k = 0; k + 4 < size; ++k) sum += square(q[first + k] - wanted[first + k]);
    }
  }
  return sum;
}

SquareError square_error(const Figures& figures, const SpringGoal& goal, const AllQ& q, const Worlds& worlds) {
  const BodyTree& tree = *figures[at(goal.figure)];
  const auto& world = worlds[at(goal.figure)];
  if (const auto* s = std::get_if<BalanceSpring>(&goal.spring)) return {square(balance_error(tree, *s, world))};
  if (const auto* s = std::get_if<PostureSpring>(&goal.spring)) return {posture_error2(tree, *s, q[at(goal.figure)])};
  const Transform base =
      goal.base_segment >= 0 ? worlds[at(goal.base_figure)][at(goal.base_segment)] : goal.world_from_base;
  const Transform& segment = world[at(goal.at.segment)];
  const Vec3 touch = segment * goal.at.point;
  const double lever = tree.document().lever;
  const auto turned = [&](const Quat& wanted) {
    return square(lever * angle_of(segment.rotation * glm::conjugate(base.rotation * wanted)));
  };
  if (const auto* s = std::get_if<PositionSpring>(&goal.spring))
    return {square(glm::length(touch - base * s->position))};
  if (const auto* s = std::get_if<OrientationSpring>(&goal.spring)) return {turned(s->rotation)};
  if (const auto* s = std::get_if<PoseSpring>(&goal.spring))
    return {square(glm::length(touch - base * s->position)), turned(s->rotation)};
  if (const auto* s = std::get_if<AimSpring>(&goal.spring)) {
    const Vec3 way = s->at_point ? base * s->to - touch : base.rotation * s->to;
    return {square(lever * angle_between(segment.rotation * s->axis, way))};
  }
  if (const auto* s = std::get_if<PlaneSpring>(&goal.spring)) {
    const double height = glm::dot(inverse(base) * touch - s->point, s->normal);
    return {square(s->above ? std::min(height, 0.0) : height)};
  }
  if (const auto* s = std::get_if<LineSpring>(&goal.spring))
    return {square(glm::length(glm::cross(inverse(base) * touch - s->point, s->direction)))};
  const auto& s = std::get<DistanceSpring>(goal.spring);
  const Vec3 other = worlds[at(goal.base_figure)][at(s.to.segment)] * s.to.point;
  const double off = glm::length(touch - other) - s.length;
  return {square(s.compare == DistanceSpring::Compare::equal      ? off
                 : s.compare == DistanceSpring::Compare::at_least ? std::min(off, 0.0)
                                                                  : std::max(off, 0.0))};
}

// What is left of a push along (x, y) where `walls` (unit, outward) stand in its way: the part that no walls can hold.
double left_over(const std::array<double, 2>& push, const std::vector<std::array<double, 2>>& walls) {
  double best = std::hypot(push[0], push[1]);
  for (const auto& n : walls) {
    const double against = std::max(0.0, n[0] * push[0] + n[1] * push[1]);
    best = std::min(best, std::hypot(push[0] - against * n[0], push[1] - against * n[1]));
    for (const auto& m : walls) {
      const double det = n[0] * m[1] - n[1] * m[0];
      if (std::abs(det) < 1e-9) continue;
      const double a = (push[0] * m[1] - push[1] * m[0]) / det, b = (n[0] * push[1] - n[1] * push[0]) / det;
      if (a >= 0.0 && b >= 0.0) best = 0.0;
    }
  }
  return best;
}

std::vector<std::array<double, 2>> walls_of(const BodyTree& tree, std::span<const double> q, int joint) {
  const LimbPose limb = limb_pose(tree, q, joint);
  const auto beyond = [&](double x, double y) {
    return beyond_swing(tree.segment(joint), glm::normalize(limb.direction + limb.across[0] * x + limb.across[1] * y));
  };
  const auto here = beyond(0.0, 0.0), right = beyond(kStep, 0.0), left = beyond(-kStep, 0.0), up = beyond(0.0, kStep),
             down = beyond(0.0, -kStep);
  std::vector<std::array<double, 2>> walls;
  for (std::size_t k = 0; k < here.size(); ++k) {
    if (here[k] < -kAtBound) continue;
    const double x = right[k] - left[k], y = up[k] - down[k], length = std::hypot(x, y);
    if (length > 0.0) walls.push_back({x / length, y / length});
  }
  return walls;
}

}  // namespace

SquareError square_error(const Figures& figures, const SpringGoal& goal, const AllQ& q) {
  return square_error(figures, goal, q, place(figures, q));
}

double cost_of(const Figures& figures, std::span<const SpringGoal> goals, const AllQ& q) {
  const Worlds worlds = place(figures, q);
  double sum = 0.0;
  for (const SpringGoal& goal : goals) {
    if (!pulls(goal)) continue;
    const SquareError e = square_error(figures, goal, q, worlds);
    sum += goal.weight * e.place + goal.orientation_weight * e.turn;
  }
  return sum;
}

std::vector<double> slope_of(const Figures& figures, std::span<const SpringGoal> goals, const AllQ& q, int figure) {
  std::vector<double> slope;
  AllQ there = q;
  const auto cost = [&](Freedom freedom, double by) {
    there[at(figure)] = moved(*figures[at(figure)], q[at(figure)], freedom, by);
    return cost_of(figures, goals, there);
  };
  for (const Freedom freedom : freedoms(*figures[at(figure)]))
    slope.push_back((cost(freedom, kStep) - cost(freedom, -kStep)) / (4.0 * kStep));
  return slope;
}

double unbalance(const Figures& figures, std::span<const SpringGoal> goals, const AllQ& q) {
  double weights = 0.0, worst = 0.0;
  for (const SpringGoal& goal : goals) {
    if (pulls(goal)) weights += goal.weight;
  }
  const double whole = std::sqrt(std::max(cost_of(figures, goals, q), 1e-12 * weights) * weights);
  for (std::size_t f = 0; f < figures.size(); ++f) {
    const BodyTree& tree = *figures[f];
    const auto slope = slope_of(figures, goals, q, static_cast<int>(f));
    const auto all = freedoms(tree);
    for (std::size_t j = 0; j < all.size(); ++j) {
      const bool limb = is_limb(tree.joint(all[j].joint));
      if (limb && all[j].k == 0)
        worst = std::max(worst, left_over({-slope[j], -slope[j + 1]}, walls_of(tree, q[f], all[j].joint)));
      if (limb && all[j].k < 2) continue;
      const auto range = spans(tree, q[f], all[j].joint);
      const auto k = at(limb ? 0 : all[j].k);
      const bool held = k < range.size() && ((slope[j] < 0.0 && range[k].value > range[k].max - kAtBound) ||
                                             (slope[j] > 0.0 && range[k].value < range[k].min + kAtBound));
      if (!held) worst = std::max(worst, std::abs(slope[j]));
    }
  }
  return weights > 0.0 ? std::max(0.0, worst - kNoPull * weights) / whole : 0.0;
}

}  // namespace posed::test
