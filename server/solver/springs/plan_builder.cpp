#include "server/solver/springs/plan_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "server/solver/springs/joint_angles.h"
#include "server/solver/springs/swing.h"

namespace posed::springs {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Effort of a rad: 1 for a joint that moves nothing else, this much more for one that moves the whole body.
constexpr double kTrunkEffort = 30.0;
constexpr double kRootTurnEffort = 300.0, kRootShiftEffort = 1000.0;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

Dof about(const Vec3& axis) {
  Dof dof;
  const DofKind kinds[3] = {DofKind::about_x, DofKind::about_y, DofKind::about_z};
  for (int k = 0; k < 3; ++k) {
    if (std::abs(axis[k]) == 1.0) {
      dof.kind = kinds[k];
      dof.sign = axis[k];
      return dof;
    }
  }
  dof.kind = DofKind::about_axis;
  dof.axis = axis;
  dof.z_to_axis = shortest_arc(kZ, axis, kX);
  return dof;
}

LinkKind kind_of(const Joint& joint) {
  switch (joint.type) {
    case JointType::free:
      return LinkKind::floating;
    case JointType::ball:
      return joint.swing || joint.twist ? LinkKind::limb : joint.limits.empty() ? LinkKind::ball : LinkKind::axes;
    case JointType::fixed:
      return LinkKind::fixed;
    case JointType::universal:
    case JointType::hinge:
    case JointType::prismatic:
      break;
  }
  return LinkKind::axes;
}

void add_dofs(const Joint& joint, LinkKind kind, double effort, Plan& plan) {
  const auto add = [&](Dof dof, const std::optional<Limit>& limit) {
    dof.min = limit ? limit->min : -kInfinity;
    dof.max = limit ? limit->max : kInfinity;
    if (dof.kind != DofKind::of_root) dof.effort = effort;
    plan.dofs.push_back(dof);
    plan.least.push_back(dof.min), plan.most.push_back(dof.max);
  };
  const auto limit = [&](std::size_t k) { return k < joint.limits.size() ? joint.limits[k] : std::nullopt; };
  Dof dof;
  if (kind == LinkKind::floating) {
    dof.kind = DofKind::of_root;
    for (int k = 0; k < 6; ++k) dof.effort = k < 3 ? kRootShiftEffort : kRootTurnEffort, add(dof, std::nullopt);
  } else if (kind == LinkKind::ball || kind == LinkKind::limb) {
    dof.kind = DofKind::of_ball;
    add(dof, std::nullopt), add(dof, std::nullopt), add(dof, joint.twist);
  } else if (joint.type == JointType::ball) {
    add(about(kX), limit(0)), add(about(kY), limit(1)), add(about(kZ), limit(2));
  } else if (joint.type == JointType::prismatic) {
    dof.kind = DofKind::along_axis;
    dof.axis = joint.axes[0];
    add(dof, limit(0));
  } else if (kind == LinkKind::axes) {
    for (std::size_t k = 0; k < joint.axes.size(); ++k) add(about(joint.axes[k]), limit(k));
  }
}

void set_limb(const Segment& segment, Link& link) {
  const double length = glm::length(segment.touch_point);
  make_limb(length > 0.0 ? segment.touch_point / length : kZ, segment.joint.swing, link);
}

// The share of the body's mass that each joint moves; without masses, of its segments.
std::vector<double> moved_shares(const BodyTree& tree) {
  std::vector<double> moved(at(tree.size()));
  double total = 0.0;
  for (int i = 0; i < tree.size(); ++i) total += tree.segment(i).mass;
  for (int i = 0; i < tree.size(); ++i) moved[at(i)] = total > 0.0 ? tree.segment(i).mass / total : 1.0 / tree.size();
  for (int i = tree.size(); i-- > 1;) moved[at(tree.parent(i))] += moved[at(i)];
  return moved;
}

// Limbs one beside the other, so that a processor finds work in one while it waits for another.
std::vector<int> by_depth(const BodyTree& tree) {
  std::vector<int> depth(at(tree.size())), order(at(tree.size()));
  for (int i = 1; i < tree.size(); ++i) depth[at(i)] = depth[at(tree.parent(i))] + 1;
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return depth[at(a)] < depth[at(b)]; });
  return order;
}

}  // namespace

Vec3 mass_point(const Segment& segment) {
  return segment.touch_point * 0.5;
}

void add_figure(const BodyTree& tree, int figure, std::span<const char> active, Plan& plan,
                std::vector<int>& link_of_segment) {
  std::vector<char> needed(active.begin(), active.end());
  for (int i = tree.size(); i-- > 1;) {
    if (needed[at(i)]) needed[at(tree.parent(i))] = 1;
  }
  const std::vector<double> moved = moved_shares(tree);
  plan.masses.resize(std::max(plan.masses.size(), at(figure + 1)), 0.0);
  link_of_segment.assign(at(tree.size()), -1);
  for (const int i : by_depth(tree)) {
    if (!needed[at(i)]) continue;
    const Segment& segment = tree.segment(i);
    const Joint& joint = segment.joint;
    Link link;
    link.kind = kind_of(joint);
    link.parent = i == 0 ? -1 : link_of_segment[at(tree.parent(i))];
    link.first = i == 0 ? static_cast<int>(plan.links.size()) : plan.links[at(link.parent)].first;
    link.figure = figure;
    link.segment = i;
    link.offset = joint.parent_from_joint.position;
    link.rotation = joint.parent_from_joint.rotation;
    link.rotated = link.rotation != quat_identity();
    link.dof = static_cast<int>(plan.dofs.size());
    link.dofs = degrees_of_freedom(joint.type);
    link.more = static_cast<int>(plan.more);
    link.mass = segment.mass;
    link.mass_point = mass_point(segment);
    if (link.kind == LinkKind::limb) set_limb(segment, link);
    plan.more += link.kind == LinkKind::ball || link.kind == LinkKind::limb ? 4
                 : link.kind == LinkKind::floating                          ? 7
                                                                            : 0;
    add_dofs(joint, link.kind, 1.0 + kTrunkEffort * moved[at(i)], plan);
    link_of_segment[at(i)] = static_cast<int>(plan.links.size());
    plan.links.push_back(link);
    plan.masses[at(figure)] += link.mass;
  }
  plan.stiffness.assign(plan.dofs.size(), 0.0);
}

void confine(const Plan& plan, State& state) {
  for (const Link& link : plan.links) {
    for (std::size_t j = at(link.dof); j < at(link.dof + link.dofs); ++j) {
      double& turn = state.turns[j];
      if (turn >= plan.least[j] && turn <= plan.most[j]) continue;
      turn = std::clamp(home(plan.dofs[j], turn), plan.least[j], plan.most[j]);
    }
    if (link.kind != LinkKind::limb) continue;
    double* more = state.more.data() + link.more;
    const Vec3 d = inside_swing(link, {more[0], more[1], more[2]});
    more[0] = d.x, more[1] = d.y, more[2] = d.z;
  }
}

}  // namespace posed::springs
