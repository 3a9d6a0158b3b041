// Joint values degree by degree, written apart from the solver's own ways: what lies outside its limits and by how
// much, random values inside them, and each degree moved a little.
#pragma once

#include <array>
#include <random>
#include <span>
#include <vector>

#include "server/solver/body_tree.h"

namespace posed::test {

// The k-th degree of freedom of a joint. Axes: its angle or way. Balls and free roots: k-th axis of the joint's frame
// at rest (root: place, then turn, in the world). Balls with swing or twist: two ways across the limb, then the twist.
struct Freedom {
  int joint = 0, k = 0;
};
std::vector<Freedom> freedoms(const BodyTree& tree);
std::vector<double> moved(const BodyTree& tree, std::vector<double> q, Freedom freedom, double by);

// How far the joint's values are outside its limits (of universal joints: off its axes), rad or m; 0: inside.
double beyond_limits(const BodyTree& tree, std::span<const double> q, int joint);
double beyond_limits(const BodyTree& tree, std::span<const double> q);  // of all joints the most

// Of an axis: its value and its range.
struct Span {
  double value, min, max;
};
std::vector<Span> spans(const BodyTree& tree, std::span<const double> q, int joint);

bool is_limb(const Joint& joint);

// A ball with swing or twist. `across`: the ways that its first two degrees of freedom move `direction`.
struct LimbPose {
  Vec3 rest, direction;
  std::array<Vec3, 2> across;
  double twist;
};
LimbPose limb_pose(const BodyTree& tree, std::span<const double> q, int joint);
// How far `direction` is beyond the edge of the swing, rad; below 0 inside. One number an edge of a polygon.
std::vector<double> beyond_swing(const Segment& segment, const Vec3& direction);

std::vector<double> random_q(std::mt19937& random, const BodyTree& tree);

}  // namespace posed::test
