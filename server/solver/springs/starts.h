// Where descents begin.
#pragma once

#include <span>
#include <vector>

#include "server/solver/springs/plan.h"
#include "server/solver/springs/terms.h"

namespace posed::springs {

void resize(const Plan& plan, State& state);
void copy(const State& from, State& to);  // of one size: keeps the memory

// kStarts + 1 poses, always the same for one plan: the first in the middle of all ranges, from where most balances are
// found, the others spread over their inner part. Roots are not set.
std::vector<State> make_starts(const Plan& plan);

// `lanes` gets the made ones but the first; the roots are where `from` has them, turned about the vertical.
void place_starts(const Plan& plan, const State& from, std::span<const State> made, std::span<State> lanes);

// The first of the made ones, with the roots where `state` has them.
void place_middle(const Plan& plan, const State& made, State& state);

// A limb that is straight has no first step that shortens it: it is bent a little about its joint's bend axis.
void bend_straight_limbs(const Plan& plan, Figures figures, State& state);

}  // namespace posed::springs
