// What springs cost and how they pull, straight from spring_goal.h by way of forward kinematics and differences: the
// judge of the spring solver, which shares nothing with it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "server/solver/spring_goal.h"
#include "tests/support/freedoms.h"

namespace posed::test {

using Figures = std::vector<std::shared_ptr<const BodyTree>>;
using AllQ = std::vector<std::vector<double>>;  // of each figure

// Squared: what counts against the goal, m^2. Of a pose goal `turn` is the orientation's.
struct SquareError {
  double place = 0.0, turn = 0.0;
};
SquareError square_error(const Figures& figures, const SpringGoal& goal, const AllQ& q);

double cost_of(const Figures& figures, std::span<const SpringGoal> goals, const AllQ& q);

// d(cost / 2) along each of freedoms(figure), by central differences.
std::vector<double> slope_of(const Figures& figures, std::span<const SpringGoal> goals, const AllQ& q, int figure);

// The steepest way down inside the limits: the largest |slope| that no limit holds, over the springs' whole strength
// (root of cost times sum of weights). 0 in a balance.
double unbalance(const Figures& figures, std::span<const SpringGoal> goals, const AllQ& q);

}  // namespace posed::test
