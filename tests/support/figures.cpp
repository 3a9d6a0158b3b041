#include "tests/support/figures.h"

#include <algorithm>
#include <span>
#include <stdexcept>

#include "server/solver/kinematics.h"
#include "server/solver/tempus.h"

namespace posed::test {
namespace {
std::string numbered(char letter, int i) {
  return std::string(1, letter).append(std::to_string(i));
}
}  // namespace

std::shared_ptr<const BodyTree> build(const FigureDocument& document) {
  auto tree = BodyTree::build(document);
  if (!tree) throw std::runtime_error(tree.error().path + ": " + tree.error().message);
  return std::make_shared<const BodyTree>(std::move(*tree));
}

std::shared_ptr<const BodyTree> human(double stature) {
  return build(tempus(stature).value());
}

FigureDocument boxed_human() {
  constexpr double kDegree = M_PI / 180.0;
  FigureDocument d = tempus(1.75).value();
  const auto box = [&](const std::string& joint, double x_min, double x_max, double y_min, double y_max, double z_min,
                       double z_max) {
    for (Segment& s : d.segments) {
      if (s.joint.name != joint) continue;
      s.joint.swing.reset(), s.joint.twist.reset();
      s.joint.limits = {Limit{x_min * kDegree, x_max * kDegree}, Limit{y_min * kDegree, y_max * kDegree},
                        Limit{z_min * kDegree, z_max * kDegree}};
    }
  };
  box("left_shoulder", -90, 90, -89, 70, -135, 45);
  box("right_shoulder", -90, 90, -89, 70, -45, 135);
  box("left_hip", -30, 45, -120, 30, -45, 45);
  box("right_hip", -45, 30, -120, 30, -45, 45);
  return d;
}

FigureDocument column(int segments, double length, JointType root) {
  FigureDocument d;
  d.root = "s0";
  for (int i = 0; i < segments; ++i) {
    Segment s;
    s.name = numbered('s', i);
    s.joint.name = numbered('j', i);
    s.joint.type = i == 0 ? root : JointType::ball;
    s.joint.bend_axis = kY;
    s.touch_point = {0, 0, length};
    if (i > 0) {
      s.parent = numbered('s', i - 1);
      s.joint.parent_from_joint.position = {0, 0, length};
    }
    d.segments.push_back(s);
  }
  return d;
}

double uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

int pick(std::mt19937& random, int size) {
  return static_cast<int>(random() % static_cast<unsigned>(size));
}

Vec3 random_point(std::mt19937& random, double reach) {
  const double x = uniform(random, -reach, reach), y = uniform(random, -reach, reach);
  return {x, y, uniform(random, -reach, reach)};
}

FigureDocument random_figure(std::mt19937& random, int most) {
  const JointType types[] = {JointType::ball,  JointType::ball,      JointType::universal,
                             JointType::hinge, JointType::prismatic, JointType::fixed};
  const int size = 2 + pick(random, most - 1);
  FigureDocument d = column(size, 0.0, pick(random, 3) > 0 ? JointType::free : types[pick(random, 6)]);
  for (int i = 0; i < static_cast<int>(d.segments.size()); ++i) {
    Segment& s = d.segments[static_cast<std::size_t>(i)];
    if (i > 0) {
      s.parent = numbered('s', std::max(0, i - 1 - pick(random, 3)));
      s.joint.type = types[pick(random, 6)];
    }
    s.joint.parent_from_joint.position = pick(random, 8) == 0 ? kZero : random_point(random, 0.5);
    const Vec3 turn = random_point(random, 1.0);
    s.joint.parent_from_joint.rotation = glm::normalize(Quat(turn.x, turn.y, turn.z, 1.0));
    s.joint.bend_axis = pick(random, 3) == 0 ? kZero : glm::normalize(random_point(random, 1.0) + Vec3(0, 0, 2));
    s.touch_point = pick(random, 8) == 0 ? kZero : random_point(random, 0.5);
    if (s.joint.type == JointType::hinge || s.joint.type == JointType::prismatic) s.joint.axes = {kZ};
    if (s.joint.type == JointType::universal) s.joint.axes = {kX, kY};
  }
  return d;
}

double worst_bone(const BodyTree& tree, const std::vector<Transform>& world) {
  double worst = 0.0;
  for (int i = 1; i < tree.size(); ++i) {
    if (tree.joint(i).type == JointType::prismatic) continue;
    const Vec3 bone =
        world[static_cast<std::size_t>(i)].position - world[static_cast<std::size_t>(tree.parent(i))].position;
    const double rest = glm::length(tree.joint(i).parent_from_joint.position);
    worst = std::max(worst, std::abs(glm::length(bone) - rest));
  }
  return worst;
}

double worst_quaternion(const BodyTree& tree, const std::vector<double>& q) {
  double worst = 0.0;
  each_quaternion(tree, [&](std::size_t first) {
    const double length = glm::length(quat_from_xyzw(std::span<const double>(q).subspan(first, 4)));
    worst = std::max(worst, std::abs(length - 1.0));
  });
  return worst;
}

bool all_finite(const Pose& pose) {
  for (const double v : pose.q) {
    if (!finite(v)) return false;
  }
  for (const Transform& t : pose.world_from_segment) {
    if (!finite(t.position) || !finite(t.rotation)) return false;
  }
  for (const GoalReport& g : pose.goals) {
    if (!finite(g.touch) || !finite(g.target) || !finite(g.error) || !finite(g.force)) return false;
  }
  return finite(pose.report.cost) && finite(pose.report.balance_error);
}

bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
  const auto one = std::as_bytes(std::span(a)), other = std::as_bytes(std::span(b));
  return std::equal(one.begin(), one.end(), other.begin(), other.end());
}

}  // namespace posed::test
