// Lays the reach tree of figures out flat, and carries joint values to and from a solve's state.
#pragma once

#include <span>
#include <vector>

#include "server/solver/body_tree.h"
#include "server/solver/springs/plan.h"

namespace posed::springs {

// The links of all segments of `tree` that are active, or have an active segment below them, are added to `plan`,
// parents first. `link_of_segment` gets the link of each, or -1.
void add_figure(const BodyTree& tree, int figure, std::span<const char> active, Plan& plan,
                std::vector<int>& link_of_segment);

// Where a segment's mass is thought to be: half way from its joint to its touch point.
Vec3 mass_point(const Segment& segment);

// Joint values of one figure -> its share of the state, whose arrays have their sizes. A quaternion that leaves the
// axes of its joint comes to near angles; nothing is clamped.
void read_q(const BodyTree& tree, int figure, const Plan& plan, std::span<const double> q, State& state);
// And back. Values of links that are not in the plan stay. Quaternions keep the sign of those in q.
void write_q(const BodyTree& tree, int figure, const Plan& plan, const State& state, std::span<double> q);

// Brings every value inside its bounds, and every limb to where it may point.
void confine(const Plan& plan, State& state);

}  // namespace posed::springs
