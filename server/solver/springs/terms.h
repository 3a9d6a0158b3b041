// From goals to what the kernels see.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "server/solver/body_tree.h"
#include "server/solver/spring_goal.h"
#include "server/solver/springs/plan.h"

namespace posed::springs {

using Figures = std::span<const std::shared_ptr<const BodyTree>>;

// Marks the segments that a goal holds or is relative to. `active[f]`: one flag a segment of figure f.
void mark_active(const SpringGoal& goal, Figures figures, std::vector<std::vector<char>>& active);

// Appends the goal's terms (none for posture, two for a pose), and its supports to the plan.
void add_terms(const SpringGoal& goal, int index, Figures figures, const std::vector<std::vector<int>>& link_of_segment,
               Plan& plan, std::vector<Term>& terms);

// Writes the goal's targets and weights into the terms that add_terms made; returns the number of them.
std::size_t update_terms(const SpringGoal& goal, Figures figures, std::span<Term> terms);

}  // namespace posed::springs
