// Why each goal stands where it does (common/pose.h: GoalReport), from how all goals pull at the joints.
#pragma once

#include <span>
#include <vector>

#include "common/pose.h"
#include "server/solver/springs/probe.h"
#include "server/solver/springs/terms.h"

namespace posed::springs {

// A pull is counted as none below this share of the whole.
inline constexpr double kNoPull = 1e-3;
inline constexpr double kReachedTurn = 0.01;   // rad
inline constexpr double kReachedPlace = 1e-3;  // m
inline constexpr std::size_t kMostCauses = 8;

class Explainer {
 public:
  // After it `explain` does not allocate.
  void prepare(const Plan& plan, std::size_t goals);

  // Plan::terms are those of all goals, as they are given. States as in the protocol:
  //   reached      the error is within the tolerance, 1 mm or 0.01 rad
  //   unreachable  it pulls, and no degree of freedom that is free to follow feels it
  //   limited      more of its pull is held by limits than by the other goals
  //   balanced     else
  // Returns the greatest slope of a free degree of freedom over that of the goal that pulls the most: 0 in perfect
  // balance.
  double explain(const Plan& plan, std::span<const SpringGoal> goals,
                 const std::vector<std::vector<int>>& link_of_segment, const State& state,
                 std::vector<GoalReport>& out);
  double cost(std::size_t goal) const { return costs_[goal]; }  // of the last explain: sum of weight x error squared

  Probe& probe() { return probe_; }

 private:
  struct Pull {
    std::size_t goal;
    double strength;
  };

  void report(const Plan& plan, const Term& term, const SpringGoal& goal, GoalReport& out);
  void report_posture(const Plan& plan, const SpringGoal& goal, std::size_t index, int root, GoalReport& out);
  // What counts as reached is the same for every part of a goal: places, turns, single joints.
  void compare(const SpringGoal& goal, std::size_t index, double error, double reached);
  void find_state(const Plan& plan, std::span<const SpringGoal> goals, std::size_t index, std::vector<GoalReport>& out);
  void name_causes(const Plan& plan, std::span<const SpringGoal> goals, std::size_t index, double held_by_limits,
                   std::vector<GoalReport>& out);
  struct Range {
    std::size_t from, to;
  };
  void find_felt(std::size_t goals);
  std::span<const Range> felt(std::size_t goal) const {
    return {felt_.data() + felt_from_[goal], felt_.data() + felt_from_[goal + 1]};
  }
  std::span<double> slope(std::size_t goal) { return {slopes_.data() + goal * dofs_, dofs_}; }

  Probe probe_;
  std::size_t dofs_ = 0;
  std::vector<double> slopes_;  // of each goal, one a degree of freedom
  // Of each goal, one after the other: the degrees of freedom that feel it and may follow. A goal far out on a large
  // figure is felt by few.
  std::vector<Range> felt_;
  std::vector<std::size_t> felt_from_;
  std::vector<double> following_;  // one goal's slope, 0 where a bound holds
  std::vector<double> total_, sprung_;
  std::vector<double> costs_;         // of each goal
  std::vector<double> apart_;         // of each goal: its error over what counts as reached
  std::vector<Probe::Bound> bounds_;  // that hold a degree of freedom against the sum of all pulls
  std::vector<Pull> pulls_;
};

}  // namespace posed::springs
