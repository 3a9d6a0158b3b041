// One check for every kind of goal: its value is what spring_goal.h says, and its derivatives are those of the value.
// `at_random` does so for a goal on the tip of a figure with a joint of each kind (test::all_joints), in random poses.
#pragma once

#include <functional>

#include "tests/support/spring_figures.h"
#include "tests/support/spring_judge.h"

namespace posed::test {

// In the pose `q`:
//   - the errors of the goal's terms amount to square_error (spring_judge.h);
//   - each row of an error is its change with the motions of the segment and of the base (not for balance, posture);
//   - the pull at every degree of freedom is the change of half the cost.
void check_derivatives(const Figures& figures, const SpringGoal& goal, const AllQ& q);

using MakeGoal = std::function<SpringGoal(std::mt19937&, const BodyTree&)>;
inline constexpr int kPoses = 40;

// World, then relative to a segment below the root, then to one of another figure.
void check_at_random(const MakeGoal& make);
// Kinds without a base.
void check_alone_at_random(const MakeGoal& make);

Vec3 random_way(std::mt19937& random);
Quat random_turn(std::mt19937& random);

// The terms' root of summed squares, as the solver sees it.
double solver_error(const Figures& figures, const SpringGoal& goal, const AllQ& q);

// A lone free segment "only" with its touch point at its origin: what it does, its root does.
std::shared_ptr<const BodyTree> lone_segment();

}  // namespace posed::test
