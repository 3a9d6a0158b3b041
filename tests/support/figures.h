// Figures for tests: the built-in one, small chains, random trees, and what must hold of any pose.
#pragma once

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "common/pose.h"
#include "server/solver/body_tree.h"

namespace posed::test {

// Throws std::runtime_error with the error's message.
std::shared_ptr<const BodyTree> build(const FigureDocument& document);
std::shared_ptr<const BodyTree> human(double stature = 1.75);
// The built-in one with boxes in place of swing and twist at shoulders and hips: all limits as hinges know them.
FigureDocument boxed_human();

// Segments s0, s1, ... one above the other along Z, each with its touch point `length` above its joint; ball joints j0,
// j1,
// ... that bend about Y, the root's as said.
FigureDocument column(int segments, double length, JointType root = JointType::free);

// A tree of 2 to `most` segments with all joint types, some links of no length, and any root.
FigureDocument random_figure(std::mt19937& random, int most);

// The same on every machine, unlike the standard's distributions. Draw one after the other, never as two arguments of
// one call: whose turn comes first is the compiler's choice there.
double uniform(std::mt19937& random, double low, double high);
int pick(std::mt19937& random, int size);
Vec3 random_point(std::mt19937& random, double reach);

// The largest change of the distance between the joints at both ends of a bone, against the figure at rest, m.
// Prismatic joints are left out.
double worst_bone(const BodyTree& tree, const std::vector<Transform>& world_from_segment);

// The largest |length - 1| among the quaternions of q.
double worst_quaternion(const BodyTree& tree, const std::vector<double>& q);

bool all_finite(const Pose& pose);

// Bit by bit: 0 is not -0, and a NaN is itself.
bool same_bytes(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace posed::test
