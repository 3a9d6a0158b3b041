// What the kernels run on: the reach tree of one or several figures laid out flat, with all that does not change while
// a solve runs. Made when the set of goals changes; targets and weights are written anew for every solve.
//
// The state of a solve is two arrays of numbers: `turns`, one a degree of freedom (rad or m; 0 for those of a ball),
// and `more`: quaternions of balls (4: x y z w) and places of floating roots (7: position, x y z w).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "common/figure.h"
#include "common/math.h"

namespace posed::springs {

enum class LinkKind {
  fixed,
  axes,      // degrees of freedom one after the other
  ball,      // a quaternion without limits
  limb,      // a quaternion whose swing and twist are limited: its degrees of freedom are outward, along and twist
  floating,  // place and quaternion in the world
};
enum class DofKind { about_x, about_y, about_z, about_axis, along_axis, of_ball, of_root };

struct Dof {
  DofKind kind = DofKind::about_x;
  double sign = 1.0;                   // about_x...: -1 turns about the negative axis
  Vec3 axis{0.0, 0.0, 0.0};            // about_axis, along_axis
  Quat z_to_axis{1.0, 0.0, 0.0, 0.0};  // about_axis: a turn that takes z to the axis
  double min = 0.0, max = 0.0;         // where there is no limit: minus and plus infinity
  double effort = 1.0;                 // what a rad^2 (or m^2) of it costs on the way from the start pose
};

struct Link {
  LinkKind kind = LinkKind::fixed;
  int parent = -1;  // link
  int first = 0;    // the root of its figure: a link
  int figure = 0, segment = 0;
  Vec3 offset{0.0, 0.0, 0.0};  // parent_from_joint
  Quat rotation{1.0, 0.0, 0.0, 0.0};
  bool rotated = false;  // rotation is not the identity
  int dof = 0, dofs = 0;
  std::size_t first_dof() const { return static_cast<std::size_t>(dof); }
  std::size_t end_dof() const { return first_dof() + static_cast<std::size_t>(dofs); }
  int more = 0;         // ball, limb, floating: where its share of `more` begins
  bool pinned = false;  // does not move
  Vec3 mass_point{0.0, 0.0, 0.0};
  double mass = 0.0;
  // limb
  Vec3 limb{0.0, 0.0, 1.0};                // direction at rest, unit
  Vec3 side{1.0, 0.0, 0.0};                // across it, unit
  Swing swing;                             // center is set
  std::array<Vec3, 2> swing_axes{kX, kY};  // of an ellipse: t0 and t1 of common/figure.h
  double surely_inside = 2.0;              // the cosine of an ellipse's lesser radius
  bool swings_freely = false;
};

enum class TermKind { point, turn, aim, plane, line, distance, balance };
enum class Sense { equal, at_least, at_most };  // which errors count: all, those below 0, those above 0

// The part of an error that counts.
inline double counted(Sense sense, double error) {
  return sense == Sense::equal ? error : sense == Sense::at_least ? std::min(error, 0.0) : std::max(error, 0.0);
}

// A goal, or the half of a pose goal, as the kernels see it: up to three errors. Frames: `place`, `direction` and
// `rotation` are in the base's frame, and in the world where the base does not move.
struct Term {
  TermKind kind = TermKind::point;
  int goal = 0;                   // index among the solver's goals
  int link = -1;                  // balance: none
  int base = -1;                  // the link that it is relative to; -1: the world
  Vec3 point{0.0, 0.0, 0.0};      // segment's frame
  Vec3 axis{1.0, 0.0, 0.0};       // aim: segment's frame
  Vec3 place{0.0, 0.0, 0.0};      // target; of plane or line a point; aim: the point; distance: the other end
  Vec3 direction{0.0, 0.0, 1.0};  // normal of the plane, direction of the line or of aim
  Quat rotation{1.0, 0.0, 0.0, 0.0};
  bool at_point = false;  // aim
  double length = 0.0;    // distance
  Sense sense = Sense::equal;
  double margin = 0.0;                  // balance
  int figure = 0;                       // balance: whose mass
  int first_support = 0, supports = 0;  // balance: in Plan::supports
  double lever = 1.0;                   // m a rad
  double weight = 0.0;
  // The error that is aimed at in place of 0, so that goals of lower priority leave this one as it is.
  std::array<double, 3> shift{0.0, 0.0, 0.0};
};

struct Support {
  int link = 0;
  Vec3 point{0.0, 0.0, 0.0};
};

// A joint's own spring: a posture goal's share, or the pull back to the start pose.
struct Rest {
  int link = 0;
  int goal = -1;                   // its index; -1: the start pose
  std::array<double, 6> weight{};  // of each degree of freedom, of rad^2 or m^2; of a limb the first's
  std::array<double, 7> at{};      // of axes their angles or ways; of balls and limbs xyzw; of roots place and xyzw
};

struct Plan {
  std::vector<Link> links;  // parents first
  std::vector<Dof> dofs;
  std::size_t more = 0;  // size of State::more
  std::vector<Term> terms;
  std::vector<Support> supports;
  std::vector<Rest> rests;
  std::vector<double> stiffness;  // of all rests together, one a degree of freedom
  std::vector<double> masses;     // of each figure, kg
  // Bounds of this solve: the dofs' own limits, or tighter ones.
  std::vector<double> least, most;

  bool sprung() const { return !rests.empty(); }
};

struct State {
  std::vector<double> turns, more;
};

}  // namespace posed::springs
