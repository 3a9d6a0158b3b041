#include "tests/bench/solver/hinge_figure.h"

#include "server/solver/ball_angles.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "server/solver/tempus.h"

namespace posed::test {
namespace {

constexpr Limit kFree{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

std::vector<Vec3> axes_of(const Joint& joint) {
  if (joint.type == JointType::ball) return {kX, kY, kZ};
  if (joint.type == JointType::universal) return joint.axes;
  throw std::runtime_error("the bench knows ball and universal joints only, not that of " + joint.name);
}

constexpr double kFromStartPose = 0.4;  // of the way to the middle of a hinge's range

double beyond(const Hinge& hinge, double angle) {
  return std::max({0.0, hinge.min - angle, angle - hinge.max});
}

// Row i of the rotation matrix in the frame (a, b, c).
struct Turned {
  Vec3 a, b, c;
  Quat r;
  double operator()(int row, int column) const {
    const Vec3 axes[] = {a, b, c};
    return glm::dot(axes[row], r * axes[column]);
  }
};

std::array<double, 2> universal_angles(const Quat& r, const Vec3& first, const Vec3& second) {
  const Turned m{first, second, glm::cross(first, second), r};
  return {std::atan2(m(2, 1), m(1, 1)), std::atan2(m(0, 2), m(0, 0))};
}

}  // namespace

HingeFigure::HingeFigure(BodyTree tree) : tree_(std::move(tree)) {
  if (!tree_.root_is_free()) throw std::runtime_error("the bench wants a free root");
  for (int i = 0; i < tree_.size(); ++i) {
    const Joint& joint = tree_.joint(i);
    Part part{tree_.segment(i).name, tree_.parent(i), joint.parent_from_joint, static_cast<int>(hinges_.size()), 0};
    above_.push_back(i == 0 ? std::vector<int>{} : above_[static_cast<std::size_t>(part.parent)]);
    if (i > 0) {
      for (const Vec3& axis : axes_of(joint)) {
        const auto k = static_cast<std::size_t>(part.hinges++);
        const Limit limit = k < joint.limits.size() ? joint.limits[k].value_or(kFree) : kFree;
        above_.back().push_back(static_cast<int>(hinges_.size()));
        hinges_.push_back({i, axis, limit.min, limit.max});
      }
    }
    parts_.push_back(std::move(part));
  }
  if (hinges_.size() != kHinges) throw std::runtime_error("the bench's figure has 48 degrees of freedom");

  start_ = from_tree_q(start_pose(tree_));
  for (std::size_t h = 0; h < hinges_.size(); ++h) {
    if (!hinges_[h].limited()) continue;
    double& angle = start_[kRootSize + h];
    angle += kFromStartPose * (0.5 * (hinges_[h].min + hinges_[h].max) - angle);
  }
}

void HingeFigure::place(std::span<const double> x, Placement& out) const {
  out.world_from_part.resize(parts_.size());
  out.axis.resize(hinges_.size());
  out.world_from_part[0] = {{x[0], x[1], x[2]}, root_turn(x)};
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    Transform world = out.world_from_part[static_cast<std::size_t>(part.parent)] * part.parent_from_joint;
    for (int k = part.first_hinge; k < part.first_hinge + part.hinges; ++k) {
      const auto h = static_cast<std::size_t>(k);
      out.axis[h] = world.rotation * hinges_[h].axis;
      world.rotation = world.rotation * quat_about(hinges_[h].axis, x[kRootSize + h]);
    }
    out.world_from_part[i] = world;
  }
}

double HingeFigure::beyond_limits(std::span<const double> x) const {
  double most = 0.0;
  for (std::size_t h = 0; h < hinges_.size(); ++h) most = std::max(most, beyond(hinges_[h], x[kRootSize + h]));
  return most;
}

std::vector<double> HingeFigure::tree_q(std::span<const double> x) const {
  std::vector<double> q(static_cast<std::size_t>(tree_.q_size()));
  std::copy_n(x.begin(), kRootSize, q.begin() + tree_.q_at(0));
  for (int i = 1; i < tree_.size(); ++i) {
    const Part& part = parts_[static_cast<std::size_t>(i)];
    Quat turn = quat_identity();
    for (int k = part.first_hinge; k < part.first_hinge + part.hinges; ++k) {
      const auto h = static_cast<std::size_t>(k);
      turn = turn * quat_about(hinges_[h].axis, x[kRootSize + h]);
    }
    const auto values = xyzw(turn);
    std::copy(values.begin(), values.end(), q.begin() + tree_.q_at(i));
  }
  return q;
}

std::vector<double> HingeFigure::from_tree_q(std::span<const double> q) const {
  std::vector<double> x(static_cast<std::size_t>(size()));
  std::copy_n(q.begin() + tree_.q_at(0), kRootSize, x.begin());
  for (int i = 1; i < tree_.size(); ++i) {
    const Part& part = parts_[static_cast<std::size_t>(i)];
    const Quat turn = quat_from_xyzw(q.subspan(static_cast<std::size_t>(tree_.q_at(i)), 4));
    const auto first = static_cast<std::size_t>(part.first_hinge);
    double* const angles = x.data() + kRootSize + first;
    if (part.hinges == 3) {
      std::array<AngleRange, 3> ranges;
      for (std::size_t k = 0; k < 3; ++k) ranges[k] = {hinges_[first + k].min, hinges_[first + k].max};
      const auto found = ball_angles(turn, ranges);
      std::copy(found.begin(), found.end(), angles);
    } else {
      const auto found = universal_angles(turn, hinges_[first].axis, hinges_[first + 1].axis);
      std::copy(found.begin(), found.end(), angles);
    }
  }
  return x;
}

}  // namespace posed::test
