// Where descents begin.
#pragma once

#include <span>
#include <vector>

#include "server/solver/springs/plan.h"
#include "server/solver/springs/terms.h"

namespace posed::springs {

void resize(const Plan& plan, State& state);

// kStarts - 1 poses spread over the inner part of all ranges, always the same for one plan. Roots are not set.
std::vector<State> make_starts(const Plan& plan);

// `lanes` gets `first` and the made ones, with the roots where `first` has them and turned about the vertical.
void place_starts(const Plan& plan, const State& first, std::span<const State> made, std::span<State> lanes);

// A limb that is straight has no first step that shortens it: it is bent a little about its joint's bend axis.
void bend_straight_limbs(const Plan& plan, Figures figures, State& state);

}  // namespace posed::springs
