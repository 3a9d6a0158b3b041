// Lays the reach tree of figures out flat.
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

// Brings every value inside its bounds, and every limb to where it may point.
void confine(const Plan& plan, State& state);

}  // namespace posed::springs
