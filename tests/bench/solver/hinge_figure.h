// The figure as all contestants can have it: a free root, then every other joint as a sequence of hinges with a range
// each. Universal: R0(first axis) R1(second axis); ball: Rx(x) Ry(y) Rz(z), in the joint's frame.
//
// Its coordinates `x` are kRootSize + hinges values: the root's x y z (m) and qx qy qz qw in the world, then the
// hinges' angles (rad), segment after segment.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "server/solver/body_tree.h"

namespace posed::test {

inline constexpr int kRootSize = 7;
inline constexpr int kFreedoms = 48;
inline constexpr int kHinges = kFreedoms - 6;

struct Hinge {
  int part = 0;
  Vec3 axis{0.0, 0.0, 1.0};     // unit; its own turn leaves it where it is, the hinges before it in the part move it
  double min = 0.0, max = 0.0;  // infinite where nothing is known
  bool limited() const { return std::isfinite(max); }
};

// A segment; the root is part 0.
struct Part {
  std::string name;
  int parent = -1;
  Transform parent_from_joint;
  int first_hinge = 0, hinges = 0;
};

struct Placement {
  std::vector<Transform> world_from_part;
  std::vector<Vec3> axis;  // of each hinge, in the world; it passes through its part's origin
};

class HingeFigure {
 public:
  // Throws std::runtime_error where the tree is no free root with balls and universal joints, kFreedoms in all. Swing
  // and twist are not known here.
  explicit HingeFigure(BodyTree tree);

  const BodyTree& tree() const { return tree_; }
  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<Hinge>& hinges() const { return hinges_; }
  int size() const { return kRootSize + kHinges; }

  // The hinges between the root and a part, those of the part too.
  const std::vector<int>& hinges_above(int part) const { return above_[static_cast<std::size_t>(part)]; }

  // The start pose with each hinge moved two fifths of the way to the middle of its range. As it is, with straight
  // limbs at the end of their ranges, solvers of one start fail at four of five 8-goal problems and there is little to
  // measure.
  const std::vector<double>& start() const { return start_; }

  // Does not allocate the second time.
  void place(std::span<const double> x, Placement& out) const;

  // The widest any hinge is beyond its range, rad; 0 inside.
  double beyond_limits(std::span<const double> x) const;

  // To q of the body tree and back. Backwards the turn of a universal joint that it cannot make is lost, and of a
  // ball's two sets of angles it is the one that suits the limits.
  std::vector<double> tree_q(std::span<const double> x) const;
  std::vector<double> from_tree_q(std::span<const double> q) const;

 private:
  BodyTree tree_;
  std::vector<Part> parts_;
  std::vector<Hinge> hinges_;
  std::vector<std::vector<int>> above_;
  std::vector<double> start_;
};

// The root's quaternion in x, or the one that is written there.
inline Quat root_turn(std::span<const double> x) {
  return quat_from_xyzw(x.subspan(3, 4));
}

}  // namespace posed::test
