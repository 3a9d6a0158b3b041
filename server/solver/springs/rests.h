// Springs of single joints in a plan: from what a goal or a start pose says to Plan::rests. No allocation within
// reserved memory.
#pragma once

#include <span>

#include "server/solver/body_tree.h"
#include "server/solver/spring_goal.h"
#include "server/solver/springs/plan.h"

namespace posed::springs {

// Where `q` has the link; `turns` are the same values as the kernels mean them. The weights are the caller's.
Rest rest_at(const BodyTree& tree, const Plan& plan, int link, std::span<const double> q, const State& turns);

// Appends one rest a joint of the goal, a posture, whose values are in `q` and `turns`.
void add_rests(const BodyTree& tree, const SpringGoal& goal, int index, std::span<const int> link_of_segment,
               std::span<const double> q, const State& turns, Plan& plan);

// Plan::stiffness, from the rests.
void sum_stiffness(Plan& plan);

}  // namespace posed::springs
