#include "server/solver/figure_check.h"

#include <set>
#include <vector>

#include "server/solver/figure_check_parts.h"

namespace posed {

using namespace figure_check;

namespace {

std::size_t axes_of(JointType type) {
  switch (type) {
    case JointType::universal:
      return 2;
    case JointType::hinge:
    case JointType::prismatic:
      return 1;
    default:
      return 0;
  }
}

Maybe check_axes(const Joint& joint, const std::string& path) {
  if (joint.axes.size() != axes_of(joint.type)) {
    return bad(
        path + "/axes", "joint " + joint.name + " has " + std::to_string(joint.axes.size()) + " axes",
        "its type has " + std::to_string(axes_of(joint.type)) + " (universal 2, hinge and prismatic 1, others 0)");
  }
  for (std::size_t k = 0; k < joint.axes.size(); ++k) {
    if (!unit(glm::length(joint.axes[k]))) {
      return bad(at(path + "/axes", k), "an axis of joint " + joint.name + " is not of unit length",
                 "divide it by its length");
    }
  }
  if (joint.axes.size() == 2 && !(std::abs(glm::dot(joint.axes[0], joint.axes[1])) < 0.999)) {
    return bad(path + "/axes", "the two axes of joint " + joint.name + " are parallel",
               "take two different directions");
  }
  const double bend = glm::length(joint.bend_axis);
  if (bend != 0.0 && !unit(bend)) {
    return bad(path + "/bend_axis", "the bend axis of joint " + joint.name + " is not of unit length",
               "divide it by its length, or leave it out");
  }
  return {};
}

Maybe check_joint(const Joint& joint, const std::string& path, bool is_root) {
  if (joint.type == JointType::free && !is_root) {
    return bad(path + "/type", "joint " + joint.name + " is free but does not join the root to the world",
               "use ball, universal, hinge, prismatic or fixed");
  }
  if (auto e = check_point(path + "/position", "the position of joint " + joint.name, joint.parent_from_joint.position))
    return e;
  if (!unit(glm::length(joint.parent_from_joint.rotation))) {
    return bad(path + "/quat_xyzw", "the quaternion of joint " + joint.name + " is not of unit length",
               "divide it by its length; no rotation is [0,0,0,1]");
  }
  if (auto e = check_axes(joint, path)) return e;
  return check_limits(joint, path);
}

Maybe check_shapes(const Segment& segment, const std::string& path) {
  if (segment.shapes.size() > kMaxShapes) {
    return bad(path, "segment " + segment.name + " has more than 64 shapes", "draw it with fewer");
  }
  for (std::size_t k = 0; k < segment.shapes.size(); ++k) {
    const Shape& s = segment.shapes[k];
    const bool sizes = s.kind == Shape::Kind::capsule || (s.b.x >= 0.0 && s.b.y >= 0.0 && s.b.z >= 0.0);
    if (sane(s.a) && sane(s.b) && sizes && s.radius >= 0.0 && s.radius <= kMaxLength) continue;
    return bad(at(path, k), "a number of a shape of segment " + segment.name + " is not finite, too large or negative",
               "give metres; radii and half sizes are not negative");
  }
  return {};
}

Maybe check_parent(const FigureDocument& d, std::size_t i, const Index& all, const std::string& path) {
  const Segment& s = d.segments[i];
  if (s.parent.empty()) {
    if (i == 0) return {};
    return bad(path, "segments " + d.segments[0].name + " and " + s.name + " both have no parent",
               "a figure has one root: name the parent of " + s.name);
  }
  const auto found = all.find(s.parent);
  if (found == all.end()) {
    std::vector<std::string> names;
    for (const Segment& other : d.segments) names.push_back(other.name);
    return bad(path, "no segment is called " + s.parent.substr(0, 64) + ", the parent of " + s.name,
               did_you_mean(s.parent, names));
  }
  if (found->second >= i) {
    return bad(path, "segment " + s.name + " stands before its parent " + s.parent,
               "list the root first and every parent before its children, without a cycle");
  }
  return {};
}

Maybe check_segments(const FigureDocument& d, Index& all) {
  if (d.segments.empty()) return bad("/segments", "the figure has no segments", "give at least a root");
  if (d.segments.size() > kMaxSegments) {
    return bad("/segments", "the figure has " + std::to_string(d.segments.size()) + " segments",
               "at most " + std::to_string(kMaxSegments) + " are allowed");
  }
  std::set<std::string> joints;
  for (std::size_t i = 0; i < d.segments.size(); ++i) {
    const Segment& s = d.segments[i];
    const std::string path = at("/segments", i);
    if (auto e = check_name(path + "/name", "segment " + std::to_string(i), s.name)) return e;
    if (!all.emplace(s.name, i).second)
      return bad(path + "/name", "two segments are called " + s.name, "give each a name of its own");
    if (auto e = check_name(path + "/joint/name", "the joint of segment " + s.name, s.joint.name)) return e;
    if (!joints.insert(s.joint.name).second)
      return bad(path + "/joint/name", "two joints are called " + s.joint.name, "give each a name of its own");
  }
  for (std::size_t i = 0; i < d.segments.size(); ++i) {
    const Segment& s = d.segments[i];
    const std::string path = at("/segments", i);
    if (auto e = check_parent(d, i, all, path + "/parent")) return e;
    if (auto e = check_joint(s.joint, path + "/joint", i == 0)) return e;
    if (auto e = check_point(path + "/touch_point", "the touch point of segment " + s.name, s.touch_point)) return e;
    if (auto e = check_shapes(s, path + "/shape")) return e;
    if (!(s.mass >= 0.0 && finite(s.mass)))
      return bad(path + "/mass", "the mass of segment " + s.name + " is negative or not finite", "give kilograms");
  }
  return {};
}

}  // namespace

std::optional<Error> check_figure(const FigureDocument& d) {
  Index all;
  if (auto e = check_segments(d, all)) return e;
  if (d.root != d.segments[0].name) {
    return bad("/root", "the root is given as " + (d.root.empty() ? std::string("nothing") : d.root.substr(0, 64)),
               "the segment without a parent is " + d.segments[0].name);
  }
  if (!(finite(d.lever) && d.lever > 0.0)) {
    return bad("/lever", "the lever is not a positive length", "give metres; 0.25 is usual for a human body");
  }
  return check_references(d, all);
}

}  // namespace posed
