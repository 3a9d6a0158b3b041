// A figure document ("posed.figure/1"): the body tree as its author writes it (paper, section "Body representation").
// Plain values; solver/body_tree.h checks them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/math.h"

namespace posed {

enum class JointType { free, ball, universal, hinge, prismatic, fixed };

inline constexpr int q_size(JointType type) {
  switch (type) {
    case JointType::free:
      return 7;  // position, quat_xyzw
    case JointType::ball:
    case JointType::universal:
      return 4;             // quat_xyzw
    case JointType::hinge:  // rad
    case JointType::prismatic:
      return 1;  // m
    case JointType::fixed:
      return 0;
  }
  return 0;
}

inline constexpr int degrees_of_freedom(JointType type) {
  switch (type) {
    case JointType::free:
      return 6;
    case JointType::ball:
      return 3;
    case JointType::universal:
      return 2;
    case JointType::hinge:
    case JointType::prismatic:
      return 1;
    case JointType::fixed:
      return 0;
  }
  return 0;
}

struct Limit {
  double min = 0.0, max = 0.0;  // rad or m
};

// Where a ball joint's limb may point: a region of directions in the joint's frame. p is the limb's direction at rest
// (joint's origin to touch point).
struct Swing {
  enum class Kind {
    ellipse,  // the direction d = exp_c(u): with t0 = X made perpendicular to c (Y if parallel) and t1 = c x t0,
              // (u.t0 / radii[0])^2 + (u.t1 / radii[1])^2 <= 1, where |u| is the angle between c and d
    polygon   // inside the convex spherical polygon `corners`, great arcs between them (Korein 1985)
  } kind = Kind::ellipse;
  Vec3 center{0.0, 0.0, 0.0};             // c, unit; zero: p
  std::array<double, 2> radii{0.0, 0.0};  // rad, above 0 and below pi
  std::vector<Vec3> corners;              // unit, three or more, counter-clockwise seen from outside
};

struct Joint {
  std::string name;
  JointType type = JointType::ball;
  Transform parent_from_joint;  // where the segment's frame lies in its parent's at rest (the root's: in the world)
  std::vector<Vec3> axes;       // unit; universal: two, hinge and prismatic: one, in the joint's frame at rest
  std::vector<std::optional<Limit>> limits;  // one a degree of freedom or none at all. Ball: the angles x, y, z of
                                             // R = Rx(x) Ry(y) Rz(z); universal: R = R0(first) R1(second)
  // A ball joint may have these in place of `limits`: its turn is that which carries p to the limb's direction by the
  // shortest arc, after a twist about p.
  std::optional<Swing> swing;
  std::optional<Limit> twist;     // rad, within -pi to pi
  Vec3 bend_axis{0.0, 0.0, 0.0};  // unit, joint's frame at rest: a straight limb bends about it; zero: no wish
};

struct Shape {
  enum class Kind { capsule, ellipsoid, box } kind = Kind::capsule;
  Vec3 a{0.0, 0.0, 0.0};  // capsule: from; else centre. Segment's frame, metres.
  Vec3 b{0.0, 0.0, 0.0};  // capsule: to; ellipsoid: radii; box: half its size
  double radius = 0.0;    // capsule
};

struct Segment {
  std::string name;
  std::string parent;               // empty: the root
  Joint joint;                      // joins the segment to its parent
  Vec3 touch_point{0.0, 0.0, 0.0};  // segment's frame
  std::vector<Shape> shapes;
  double mass = 0.0;  // kg
};

struct Site {
  std::string segment;
  Vec3 point{0.0, 0.0, 0.0};
};

struct FigureDocument {
  std::string root;
  std::vector<Segment> segments;  // parent before child
  std::map<std::string, Site> sites;
  std::vector<std::pair<std::string, std::string>> mirror;
  std::map<std::string, std::string> aliases;
  double lever = 0.25;  // m; an angle counts as arc on it
};

}  // namespace posed
