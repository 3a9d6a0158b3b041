#include "tests/support/freedoms.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/figures.h"

namespace posed::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::span<double> share_of(const BodyTree& tree, std::vector<double>& q, int joint) {
  return std::span(q).subspan(static_cast<std::size_t>(tree.q_at(joint)),
                              static_cast<std::size_t>(q_size(tree.joint(joint).type)));
}

Quat quat_of(const BodyTree& tree, std::span<const double> q, int joint) {
  return quat_from_xyzw(q.subspan(static_cast<std::size_t>(tree.q_at(joint)), 4));
}

void put(const Quat& r, std::span<double> to) {
  const auto v = xyzw(glm::normalize(same_sign(quat_from_xyzw(to), r)));
  std::copy(v.begin(), v.end(), to.begin());
}

// The limb's direction at rest.
Vec3 rest_of(const Segment& segment) {
  return glm::length(segment.touch_point) > 0.0 ? glm::normalize(segment.touch_point) : kZ;
}

double turn_about(const Quat& r, const Vec3& axis) {
  return std::remainder(2.0 * std::atan2(glm::dot(Vec3(r.x, r.y, r.z), axis), r.w), 2.0 * M_PI);
}

// The angles of R = R0 R1 R2 about perpendicular axes, from the entries of its matrix in their frame.
std::array<double, 3> angles_of(const Quat& r, const Vec3& a0, const Vec3& a1) {
  const Vec3 a2 = glm::cross(a0, a1);
  const auto m = [&](const Vec3& row, const Vec3& column) { return glm::dot(row, r * column); };
  const double across = std::hypot(m(a0, a0), m(a0, a1)), y = std::atan2(m(a0, a2), across);
  if (across < 1e-9) return {std::atan2(m(a2, a1), m(a1, a1)), y, 0.0};
  return {std::atan2(-m(a1, a2), m(a2, a2)), y, std::atan2(-m(a0, a1), m(a0, a0))};
}

std::array<double, 3> the_other(const std::array<double, 3>& a) {
  return {a[0] + M_PI, M_PI - a[1], a[2] + M_PI};
}

// Where two angles are one, neither is known better than rounding over how far it is to there: nearer than one over
// this (rad) they count by that much less.
constexpr double kNearOne = 10.0;

// The third is what leads off the two axes.
std::array<double, 3> universal_angles(const Quat& r, const Joint& joint) {
  const auto a = angles_of(r, joint.axes[0], joint.axes[1]), b = the_other(a);
  const double off_a = std::remainder(a[2], 2.0 * M_PI), off_b = std::remainder(b[2], 2.0 * M_PI);
  return std::abs(off_a) <= std::abs(off_b) ? std::array{a[0], a[1], off_a} : std::array{b[0], b[1], off_b};
}

// An angle is as good with whole turns more or less.
double nearest(double angle, const Limit& limit) {
  const double middle = 0.5 * (limit.min + limit.max);
  return middle + std::remainder(angle - middle, 2.0 * M_PI);
}

double beyond(const std::vector<Span>& spans) {
  double worst = 0.0;
  for (const Span& s : spans) worst = std::max({worst, s.min - s.value, s.value - s.max});
  return worst;
}

Quat composed(const std::array<double, 3>& angles, const Vec3& a0, const Vec3& a1) {
  return quat_about(a0, angles[0]) * quat_about(a1, angles[1]) * quat_about(glm::cross(a0, a1), angles[2]);
}

}  // namespace

bool is_limb(const Joint& joint) {
  return joint.type == JointType::ball && (joint.swing || joint.twist);
}

LimbPose limb_pose(const BodyTree& tree, std::span<const double> q, int joint) {
  const Vec3 p = rest_of(tree.segment(joint));
  const Quat r = quat_of(tree, q, joint);
  const Vec3 d = r * p, first = perpendicular(d, kX);
  const Quat twist = glm::conjugate(shortest_arc(p, d, perpendicular(p, kX))) * r;
  return {p, d, {first, glm::cross(d, first)}, turn_about(twist, p)};
}

std::vector<double> beyond_swing(const Segment& segment, const Vec3& d) {
  if (!segment.joint.swing) return {};
  const Swing& swing = *segment.joint.swing;
  std::vector<double> out;
  if (swing.kind == Swing::Kind::ellipse) {
    const Vec3 c = swing.center == kZero ? rest_of(segment) : swing.center;
    const Vec3 t0 = perpendicular(c, std::abs(c.x) > 0.999999 ? kY : kX), t1 = glm::cross(c, t0);
    const double angle = std::atan2(glm::length(glm::cross(c, d)), glm::dot(c, d));
    const double heading = std::atan2(glm::dot(d, t1), glm::dot(d, t0));
    const double edge = 1.0 / std::hypot(std::cos(heading) / swing.radii[0], std::sin(heading) / swing.radii[1]);
    out.push_back(angle - edge);
  } else {
    for (std::size_t k = 0; k < swing.corners.size(); ++k) {
      const Vec3 inward = glm::normalize(glm::cross(swing.corners[k], swing.corners[(k + 1) % swing.corners.size()]));
      out.push_back(-std::asin(std::clamp(glm::dot(inward, d), -1.0, 1.0)));
    }
  }
  return out;
}

std::vector<Span> spans(const BodyTree& tree, std::span<const double> q, int i) {
  const Joint& joint = tree.joint(i);
  const auto span = [&](double value, std::size_t k) {
    const auto limit = k < joint.limits.size() ? joint.limits[k] : std::nullopt;
    if (limit && q_size(joint.type) == 4) value = nearest(value, *limit);
    return Span{value, limit ? limit->min : -kInfinity, limit ? limit->max : kInfinity};
  };
  if (is_limb(joint)) {
    const Limit twist = joint.twist.value_or(Limit{-kInfinity, kInfinity});
    return {{limb_pose(tree, q, i).twist, twist.min, twist.max}};
  }
  if (q_size(joint.type) == 1) return {span(q[static_cast<std::size_t>(tree.q_at(i))], 0)};
  if (joint.type == JointType::universal) {
    const auto a = universal_angles(quat_of(tree, q, i), joint);
    return {span(a[0], 0), span(a[1], 1)};
  }
  if (joint.type == JointType::ball && !joint.limits.empty()) {
    // One turn has two sets of angles, each of them good for any whole turns; on its side it has any number of them.
    const auto a = angles_of(quat_of(tree, q, i), kX, kY), b = the_other(a);
    const auto of = [&](const std::array<double, 3>& angles) {
      return std::vector<Span>{span(angles[0], 0), span(angles[1], 1), span(angles[2], 2)};
    };
    auto best = beyond(of(a)) <= beyond(of(b)) ? of(a) : of(b);
    const double side = a[1] > 0.0 ? 1.0 : -1.0;
    const bool on_its_side = std::abs(std::abs(a[1]) - 0.5 * M_PI) < 1e-9;
    const auto try_first = [&](double x) {
      const auto there = of({x, a[1], side * (a[0] - x)});
      if (beyond(there) < beyond(best)) best = there;
    };
    for (int n = 0; on_its_side && n < 1000; ++n) try_first(2.0 * M_PI * n / 1000.0 - M_PI);
    for (const auto& limit : joint.limits) {
      if (on_its_side && limit) try_first(limit->min), try_first(limit->max);
    }
    if (on_its_side && joint.limits[2]) {
      for (const double z : {joint.limits[2]->min, joint.limits[2]->max}) try_first(a[0] - side * z);
    }
    return best;
  }
  return {};
}

double beyond_limits(const BodyTree& tree, std::span<const double> q, int i) {
  double worst = beyond(spans(tree, q, i));
  if (is_limb(tree.joint(i))) {
    const LimbPose at = limb_pose(tree, q, i);
    // Where a limb points straight back, all twists are one.
    worst *= std::min(1.0, kNearOne * glm::length(at.rest + at.direction));
    for (const double beyond : beyond_swing(tree.segment(i), at.direction)) worst = std::max(worst, beyond);
  } else if (tree.joint(i).type == JointType::universal) {
    // At a quarter turn of the second angle the first does what the third does.
    const auto a = universal_angles(quat_of(tree, q, i), tree.joint(i));
    worst = std::max(worst, std::abs(a[2]) * std::min(1.0, kNearOne * std::abs(std::cos(a[1]))));
  }
  return worst;
}

double beyond_limits(const BodyTree& tree, std::span<const double> q) {
  double worst = 0.0;
  for (int i = 0; i < tree.size(); ++i) worst = std::max(worst, beyond_limits(tree, q, i));
  return worst;
}

std::vector<Freedom> freedoms(const BodyTree& tree) {
  std::vector<Freedom> all;
  for (int i = 0; i < tree.size(); ++i) {
    for (int k = 0; k < degrees_of_freedom(tree.joint(i).type); ++k) all.push_back({i, k});
  }
  return all;
}

std::vector<double> moved(const BodyTree& tree, std::vector<double> q, Freedom freedom, double by) {
  const Joint& joint = tree.joint(freedom.joint);
  const std::span<double> share = share_of(tree, q, freedom.joint);
  const auto k = static_cast<std::size_t>(freedom.k);
  const Vec3 axes[3] = {kX, kY, kZ};
  if (joint.type == JointType::free) {
    if (k < 3)
      share[k] += by;
    else
      put(quat_about(axes[k - 3], by) * quat_from_xyzw(share.subspan(3)), share.subspan(3));
  } else if (is_limb(joint)) {
    const LimbPose at = limb_pose(tree, q, freedom.joint);
    const Vec3 d = k < 2 ? at.direction * std::cos(by) + at.across[k] * std::sin(by) : at.direction;
    put(shortest_arc(at.rest, d, perpendicular(at.rest, kX)) * quat_about(at.rest, at.twist + (k == 2 ? by : 0.0)),
        share);
  } else if (joint.type == JointType::universal || (joint.type == JointType::ball && !joint.limits.empty())) {
    const bool ball = joint.type == JointType::ball;
    const Vec3 a0 = ball ? kX : joint.axes[0], a1 = ball ? kY : joint.axes[1];
    auto angles = ball ? angles_of(quat_from_xyzw(share), a0, a1) : universal_angles(quat_from_xyzw(share), joint);
    const auto told = spans(tree, q, freedom.joint);
    for (std::size_t n = 0; n < told.size(); ++n) angles[n] = told[n].value;
    angles[k] += by;
    put(composed(angles, a0, a1), share);
  } else if (joint.type == JointType::ball) {
    put(quat_about(axes[k], by) * quat_from_xyzw(share), share);
  } else {
    share[0] += by;
  }
  return q;
}

std::vector<double> random_q(std::mt19937& random, const BodyTree& tree) {
  std::vector<double> q = tree.rest();
  const auto within = [&](double min, double max) {
    return uniform(random, std::isfinite(min) ? min : -M_PI, std::isfinite(max) ? max : M_PI);
  };
  for (int i = 0; i < tree.size(); ++i) {
    const Joint& joint = tree.joint(i);
    const std::span<double> share = share_of(tree, q, i);
    const auto any = [&] {
      const Vec3 v = random_point(random, 1.0);
      return glm::normalize(Quat(uniform(random, -1.0, 1.0), v.x, v.y, v.z));
    };
    const auto s = spans(tree, tree.rest(), i);
    if (joint.type == JointType::free) {
      const Vec3 place = random_point(random, 1.0);
      share[0] = place.x, share[1] = place.y, share[2] = place.z;
      put(any(), share.subspan(3));
    } else if (is_limb(joint)) {
      const Vec3 p = rest_of(tree.segment(i));
      Vec3 d = p;
      for (int n = 0; n < 10'000; ++n) {
        d = glm::normalize(random_point(random, 1.0));
        const auto beyond = beyond_swing(tree.segment(i), d);
        if (std::all_of(beyond.begin(), beyond.end(), [](double b) { return b <= 0.0; })) break;
      }
      put(shortest_arc(p, d, perpendicular(p, kX)) * quat_about(p, within(s[0].min, s[0].max)), share);
    } else if (joint.type == JointType::universal) {
      const double first = within(s[0].min, s[0].max);
      put(composed({first, within(s[1].min, s[1].max), 0.0}, joint.axes[0], joint.axes[1]), share);
    } else if (joint.type == JointType::ball && !joint.limits.empty()) {
      const double x = within(s[0].min, s[0].max), y = within(s[1].min, s[1].max);
      put(composed({x, y, within(s[2].min, s[2].max)}, kX, kY), share);
    } else if (joint.type == JointType::ball) {
      put(any(), share);
    } else if (!share.empty()) {
      share[0] = within(s[0].min, s[0].max);
    }
  }
  return q;
}

}  // namespace posed::test
