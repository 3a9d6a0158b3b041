// A Pose is one solved figure, with the reasons for it.
#pragma once

#include <string>
#include <vector>

#include "common/math.h"

namespace posed {

enum class GoalState { off, reached, unreachable, limited, balanced };
enum class SolveStatus { converged, deadline, stalled };

struct Cause {
  enum class Kind { goal, beyond, limit } kind = Kind::goal;
  int goal = -1;                                         // index among the pose's goals: it holds this one
  double beyond_m = 0.0;                                 // how far the target lies beyond the straight chain
  int figure = 0;                                        // of those that were solved as one: whose joint
  int joint = -1;                                        // by its segment: its limit holds this goal
  enum class Side { min, max, swing } side = Side::min;  // of that limit
};

struct GoalReport {
  Vec3 touch{0.0, 0.0, 0.0};   // world, m
  Vec3 target{0.0, 0.0, 0.0};  // world, m
  double error = 0.0;          // m
  Vec3 force{0.0, 0.0, 0.0};   // weight x (target - touch)
  GoalState state = GoalState::off;
  std::vector<Cause> causes;
};

struct SolveReport {
  SolveStatus status = SolveStatus::converged;
  double cost = 0.0;           // sum of weight x error squared
  double balance_error = 0.0;  // |sum of weight x displacement| at the reach tree's root, as a share of its terms
  int iterations = 0;          // passes at the root
  int chain_solves = 0;
  bool branch_changed = false;
};

struct Pose {
  std::vector<double> q;                      // as the figure's q_layout says
  std::vector<Transform> world_from_segment;  // in the order of the figure's segments
  std::vector<GoalReport> goals;              // in the order in which they were given
  SolveReport report;
};

}  // namespace posed
