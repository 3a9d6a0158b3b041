#include "tests/support/spring_figures.h"

#include <array>
#include <string>

#include "tests/support/freedoms.h"

namespace posed::test {
namespace {

// A segment at the end of `parent`'s bone.
Segment& add(FigureDocument& d, const std::string& name, const std::string& parent, JointType type, const Vec3& place,
             const Vec3& touch) {
  Segment s;
  s.name = name;
  s.parent = parent;
  s.joint.name = name + "_joint";
  s.joint.type = type;
  s.joint.parent_from_joint.position = place;
  s.touch_point = touch;
  s.mass = 1.0 + 2.0 * glm::length(touch);
  if (d.segments.empty()) d.root = name;
  d.segments.push_back(s);
  return d.segments.back();
}

std::optional<Limit> maybe(std::mt19937& random, double most) {
  const double a = uniform(random, -most, most), b = uniform(random, -most, most);
  switch (pick(random, 5)) {
    case 0:
      return std::nullopt;
    case 1:
      return Limit{a, a};
    default:
      return Limit{std::min(a, b), std::max(a, b)};
  }
}

Vec3 way(std::mt19937& random) {
  return glm::normalize(random_point(random, 1.0) + Vec3(1e-3, 0, 0));
}

Quat turned(std::mt19937& random) {
  const Vec3 v = random_point(random, 1.0);
  return glm::normalize(Quat(uniform(random, -1.0, 1.0) + 1e-3, v.x, v.y, v.z));
}

void limit(std::mt19937& random, Segment& s) {
  Joint& joint = s.joint;
  if (joint.type == JointType::ball && pick(random, 2) == 0) {
    if (pick(random, 3) > 0) {
      const double first = uniform(random, 0.05, 2.5), second = uniform(random, 0.05, 2.5);
      joint.swing = ellipse(first, second);
      if (pick(random, 2) == 0) joint.swing->center = way(random);
    } else {
      const Vec3 c = way(random), x = perpendicular(c, kX), y = glm::cross(c, x);
      const double size = uniform(random, 0.1, 2.0);
      joint.swing = polygon({c + x * size, c + y * size, c - x * size, c - y * size});
    }
  }
  if (joint.type == JointType::ball && pick(random, 2) == 0) {
    const double a = uniform(random, -M_PI, M_PI), b = uniform(random, -M_PI, M_PI);
    joint.twist = Limit{std::min(a, b), std::max(a, b)};
  }
  if (joint.swing || joint.twist || joint.type == JointType::free || pick(random, 3) == 0) return;
  const bool slides = joint.type == JointType::prismatic;
  for (int k = 0; k < degrees_of_freedom(joint.type); ++k)
    joint.limits.push_back(maybe(random, slides ? 0.3 : joint.type == JointType::ball ? 1.5 : 3.0));
}

}  // namespace

Swing ellipse(double first, double second) {
  Swing s;
  s.radii = {first, second};
  return s;
}

Swing polygon(std::vector<Vec3> corners) {
  Swing s;
  s.kind = Swing::Kind::polygon;
  for (Vec3& c : corners) c = glm::normalize(c);
  s.corners = std::move(corners);
  return s;
}

FigureDocument all_joints(JointType root) {
  FigureDocument d;
  Segment* s = &add(d, "base", "", root, {0.1, 0.2, 0.3}, {0, 0, 0.3});
  if (root == JointType::hinge || root == JointType::prismatic) s->joint.axes = {kY};
  if (root == JointType::universal) s->joint.axes = {kX, kY};
  s = &add(d, "hinge", "base", JointType::hinge, {0, 0.1, 0.3}, {0.3, 0, 0.1});
  s->joint.axes = {glm::normalize(Vec3(1, 2, 3))};
  s->joint.limits = {Limit{-1.5, 1.0}};
  s->joint.parent_from_joint.rotation = quat_about(kY, 0.4);
  s = &add(d, "universal", "hinge", JointType::universal, {0.3, 0, 0.1}, {0, 0.25, 0.1});
  s->joint.axes = {kZ, kX};
  s->joint.limits = {Limit{-1.0, 2.0}, Limit{-0.5, 1.2}};
  s = &add(d, "boxed", "universal", JointType::ball, {0, 0.25, 0.1}, {0.1, 0.2, 0.1});
  s->joint.limits = {Limit{-1.0, 1.5}, Limit{-1.2, 1.0}, Limit{-2.0, 0.7}};
  s->joint.parent_from_joint.rotation = quat_about(kX, -0.7);
  s = &add(d, "ball", "boxed", JointType::ball, {0.1, 0.2, 0.1}, {0.2, 0.1, -0.2});
  s = &add(d, "ellipse", "ball", JointType::ball, {0.2, 0.1, -0.2}, {0.1, -0.2, 0.2});
  s->joint.swing = ellipse(0.9, 0.5);
  s->joint.twist = Limit{-1.0, 1.4};
  s->joint.parent_from_joint.rotation = quat_about(kZ, 1.1);
  s = &add(d, "polygon", "ellipse", JointType::ball, {0.1, -0.2, 0.2}, {0, 0, 0.3});
  s->joint.swing = polygon({{1, 0.2, 1}, {0.1, 1, 1}, {-0.8, 0, 1}, {0, -1, 1.2}});
  s->joint.twist = Limit{-0.8, 0.8};
  s = &add(d, "slide", "polygon", JointType::prismatic, {0, 0, 0.3}, {0.2, 0, 0.1});
  s->joint.axes = {glm::normalize(Vec3(1, 0, 1))};
  s->joint.limits = {Limit{-0.1, 0.2}};
  s = &add(d, "tip", "slide", JointType::fixed, {0.2, 0, 0.1}, {0, 0, 0.15});
  s->joint.parent_from_joint.rotation = quat_about(kY, 0.5);
  return d;
}

FigureDocument random_limited_figure(std::mt19937& random, int most) {
  FigureDocument d = random_figure(random, most);
  for (Segment& s : d.segments) {
    if (s.joint.type == JointType::hinge || s.joint.type == JointType::prismatic) {
      s.joint.axes = {pick(random, 2) == 0 ? kZ : way(random)};
    } else if (s.joint.type == JointType::universal) {
      const Vec3 first = way(random);
      s.joint.axes = {first, perpendicular(first, kX)};
    }
    s.mass = pick(random, 4) == 0 ? 0.0 : uniform(random, 0.1, 10.0);
    limit(random, s);
  }
  d.segments.back().mass = 1.0;
  return d;
}

FigureDocument hand_with_fingers() {
  FigureDocument d;
  add(d, "palm", "", JointType::free, kZero, {0.09, 0, 0});
  const char* const names[] = {"thumb", "index", "middle", "ring", "little"};
  for (int f = 0; f < 5; ++f) {
    std::string parent = "palm";
    Vec3 place(f == 0 ? 0.02 : 0.09, 0.045 - 0.02 * f, 0.0);
    for (int k = 0; k < 3; ++k) {
      const Vec3 bone(0.045 - 0.01 * k, 0, 0);
      const std::string name = names[f] + std::to_string(k);
      Segment& s = add(d, name, parent, k == 0 ? JointType::universal : JointType::hinge, place, bone);
      s.joint.axes = {kY};
      s.joint.limits = {Limit{-0.2, 1.6}};
      if (k == 0) s.joint.axes = {kZ, kY}, s.joint.limits = {Limit{-0.3, 0.3}, Limit{-0.3, 1.6}};
      s.joint.bend_axis = kY;
      parent = name;
      place = bone;
    }
  }
  return d;
}

FigureDocument quadruped() {
  FigureDocument d;
  add(d, "trunk", "", JointType::free, {0, 0, 0.8}, {0.5, 0, 0}).mass = 20.0;
  for (const int x : {1, -1}) {
    for (const int y : {1, -1}) {
      const std::string leg = std::string(x > 0 ? "front_" : "hind_") + (y > 0 ? "left" : "right");
      Segment& upper = add(d, leg + "_upper", "trunk", JointType::ball, {0.45 * x, 0.15 * y, 0}, {0, 0, -0.35});
      upper.joint.swing = ellipse(1.0, 0.5);
      upper.joint.twist = Limit{-0.3, 0.3};
      Segment& lower = add(d, leg + "_lower", leg + "_upper", JointType::hinge, {0, 0, -0.35}, {0, 0, -0.35});
      lower.joint.axes = {kY};
      lower.joint.limits = {Limit{-0.1, 2.2}};
      lower.joint.bend_axis = kY;
      add(d, leg + "_paw", leg + "_lower", JointType::universal, {0, 0, -0.35}, {0.08, 0, -0.08}).joint.axes = {kY, kX};
    }
  }
  add(d, "neck", "trunk", JointType::ball, {0.5, 0, 0.1}, {0.3, 0, 0.2}).joint.limits = {
      Limit{-0.5, 0.5}, Limit{-0.8, 0.8}, Limit{-0.7, 0.7}};
  add(d, "tail", "trunk", JointType::ball, {-0.5, 0, 0.05}, {-0.3, 0, 0});
  return d;
}

SpringGoal goal_at(const BodyTree& tree, const char* segment, Spring spring, double weight) {
  SpringGoal goal;
  goal.at = tree.attach({segment, {}, ""}).value();
  goal.spring = std::move(spring);
  goal.weight = goal.orientation_weight = weight;
  return goal;
}

SpringGoal random_goal(std::mt19937& random, const std::vector<std::shared_ptr<const BodyTree>>& figures, int kind,
                       double reach) {
  const auto some_figure = [&] { return pick(random, static_cast<int>(figures.size())); };
  SpringGoal goal;
  goal.figure = some_figure();
  const BodyTree& tree = *figures[static_cast<std::size_t>(goal.figure)];
  goal.at = {pick(random, tree.size()), random_point(random, 0.3)};
  goal.base_figure = some_figure();
  const BodyTree& base = *figures[static_cast<std::size_t>(goal.base_figure)];
  const Vec3 place = random_point(random, reach);
  switch (kind) {
    case 0:
      goal.spring = PositionSpring{place};
      break;
    case 1:
      goal.spring = OrientationSpring{turned(random)};
      break;
    case 2:
      goal.spring = PoseSpring{place, turned(random)};
      break;
    case 3: {
      const bool at_point = pick(random, 2) == 0;
      goal.spring = AimSpring{way(random), at_point, at_point ? place : way(random)};
      break;
    }
    case 4:
      goal.spring = PlaneSpring{place, way(random), pick(random, 2) == 0};
      break;
    case 5:
      goal.spring = LineSpring{place, way(random)};
      break;
    case 6:
      goal.spring = DistanceSpring{{pick(random, base.size()), random_point(random, 0.3)},
                                   uniform(random, 0.0, reach),
                                   static_cast<DistanceSpring::Compare>(pick(random, 3))};
      return goal;
    case 7: {
      BalanceSpring balance;
      for (int k = 1 + pick(random, 5); k > 0; --k)
        balance.support.push_back({pick(random, tree.size()), random_point(random, 0.3)});
      goal.spring = balance;
      return goal;
    }
    default: {
      PostureSpring posture;
      const auto q = random_q(random, tree);
      for (int i = 0; i < tree.size(); ++i) {
        if (pick(random, 2) == 0) continue;
        posture.joints.push_back(i);
        for (int k = 0; k < q_size(tree.joint(i).type); ++k)
          posture.values.push_back(q[static_cast<std::size_t>(tree.q_at(i) + k)]);
      }
      goal.spring = posture;
      return goal;
    }
  }
  if (pick(random, 4) == 0)
    goal.base_segment = pick(random, base.size());
  else if (pick(random, 2) == 0)
    goal.world_from_base = {random_point(random, 0.5), turned(random)};
  return goal;
}

}  // namespace posed::test
