// Timing a contestant over a set, what comes out as rows, and what our own rows are held against.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/solver/contestant.h"

namespace posed::test {

inline constexpr const char* kOurs = "posed/springs";
inline constexpr const char* kFloor = "floor";

struct Row {
  Row(std::string of_set, std::string of_whom) : set(std::move(of_set)), who(std::move(of_whom)) {}

  std::string set, who;
  double median_us = 0.0, p99_us = 0.0;
  double ok = 0.0;      // share of the answers within kJudgedRms and the limits; where not reachable: within the limits
  double inside = 0.0;  // share of the answers within the limits
  double ratio_floor = 0.0;
  std::optional<double> cost_ratio;  // geometric mean over the problems, against the best peer (sets out of reach)
  int problems = 0, runs = 0;        // how many, and of how many runs each time is the least
  std::vector<double> costs;         // of each problem; those that were left out are negative
};

// One row; ratio_floor and cost_ratio are still to be filled in. A slow contestant gets every tenth problem.
Row race(const HingeFigure& figure, Contestant& contestant, const ProblemSet& set);

// Forward kinematics (posed's own), all joint axes in the world and 8 points, scalar: one row.
Row floor_row(const HingeFigure& figure, const Problem& eight);

// Fills in cost_ratio of the rows of one set. The best peer is the one that keeps the limits and has the least
// geometric mean of costs over the problems that all of them had.
void compare_costs(std::vector<Row>& rows);

struct Gate {
  std::string what;
  double value = 0.0, bound = 0.0;
  bool at_least = false;
  bool held() const { return at_least ? value >= bound : value <= bound; }
};

// What `rows` of all sets are held against: the peer's honesty and, where kOurs is among them, our speed. A speed gate
// is against the fastest peer (by its median) that keeps the limits and solves 95 % of the set.
std::vector<Gate> gates(const std::vector<Row>& rows, bool wide_lanes);

}  // namespace posed::test
