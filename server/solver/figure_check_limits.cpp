// Where joints may go: limits, and of ball joints swing and twist.
#include "server/solver/figure_check_parts.h"

namespace posed::figure_check {
namespace {

// Below this a corner lies on its neighbours' great arc, or on a neighbour.
constexpr double kLeast = 1e-9;

Maybe check_ranges(const Joint& joint, const std::string& path) {
  const auto dof = static_cast<std::size_t>(degrees_of_freedom(joint.type));
  if (!joint.limits.empty() && joint.limits.size() != dof) {
    return bad(path,
               "joint " + joint.name + " has " + std::to_string(joint.limits.size()) + " limits for " +
                   std::to_string(dof) + " degrees of freedom",
               "give one [min, max] or null for each, or no limits at all");
  }
  for (std::size_t k = 0; k < joint.limits.size(); ++k) {
    const auto& limit = joint.limits[k];
    if (limit && !(finite(limit->min) && finite(limit->max) && limit->min <= limit->max)) {
      return bad(at(path, k), "a limit of joint " + joint.name + " is not a range",
                 "give [min, max] with min <= max, in radians or metres");
    }
  }
  return {};
}

Maybe check_ellipse(const Joint& joint, const std::string& path) {
  const Swing& swing = *joint.swing;
  for (std::size_t k = 0; k < 2; ++k) {
    if (!(swing.radii[k] > 0.0 && swing.radii[k] < M_PI))
      return bad(at(path + "/ellipse", k), "a swing radius of joint " + joint.name + " is out of range",
                 "give radians above 0 and below pi");
  }
  if (swing.center != kZero && !unit(glm::length(swing.center))) {
    return bad(path + "/center", "the swing centre of joint " + joint.name + " is not of unit length",
               "divide it by its length, or leave it out: then it is the limb's direction at rest");
  }
  return {};
}

Maybe check_polygon(const Joint& joint, const std::string& path) {
  const std::vector<Vec3>& corners = joint.swing->corners;
  const std::size_t n = corners.size();
  if (n < 3 || n > kMaxCorners) {
    return bad(path, "the swing polygon of joint " + joint.name + " has " + std::to_string(n) + " corners",
               "give 3 to 64");
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (!unit(glm::length(corners[k])))
      return bad(at(path, k), "a swing corner of joint " + joint.name + " is not of unit length",
                 "divide it by its length");
  }
  // Each edge has all the other corners on its left: that is convex, simple and counter-clockwise at once.
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const Vec3 inward = glm::cross(corners[i], corners[j]);
    for (std::size_t k = 0; k < n; ++k) {
      if (k == i || k == j || glm::dot(inward, corners[k]) > kLeast) continue;
      return bad(at(path, k), "the swing polygon of joint " + joint.name + " is not convex here",
                 "list corners counter-clockwise seen from outside, none twice, and none on a side");
    }
  }
  return {};
}

}  // namespace

Maybe check_limits(const Joint& joint, const std::string& path) {
  if (auto e = check_ranges(joint, path + "/limits")) return e;
  if (!joint.swing && !joint.twist) return {};
  const std::string which = joint.swing ? "/swing" : "/twist";
  if (joint.type != JointType::ball)
    return bad(path + which, "joint " + joint.name + " is no ball joint, so it has no swing and no twist",
               "use limits, one a degree of freedom");
  if (!joint.limits.empty())
    return bad(path + which, "joint " + joint.name + " has limits and a swing or twist too", "leave one of them out");
  if (joint.swing) {
    const bool ellipse = joint.swing->kind == Swing::Kind::ellipse;
    if (auto e = ellipse ? check_ellipse(joint, path + "/swing") : check_polygon(joint, path + "/swing/polygon"))
      return e;
  }
  if (joint.twist && !(joint.twist->min >= -M_PI && joint.twist->max <= M_PI && joint.twist->min <= joint.twist->max)) {
    return bad(path + "/twist", "the twist of joint " + joint.name + " is not a range",
               "give [min, max] with min <= max, in radians from -pi to pi");
  }
  return {};
}

}  // namespace posed::figure_check
