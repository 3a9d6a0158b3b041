// One spring solver with its figures, goals and start: what the tests of the solver share.
#pragma once

#include <algorithm>

#include "server/solver/kinematics.h"
#include "server/solver/springs/spring_solver.h"
#include "server/solver/tempus.h"
#include "tests/support/spring_figures.h"
#include "tests/support/spring_judge.h"

namespace posed::test {

struct SpringBench {
  Figures figures;
  SpringSolver solver;
  AllQ start;
  std::vector<SpringGoal> goals;
  SpringOptions options;

  explicit SpringBench(Figures all) : figures(std::move(all)), solver(figures) {
    for (const auto& figure : figures) start.push_back(start_pose(*figure));
  }
  explicit SpringBench(std::shared_ptr<const BodyTree> figure) : SpringBench(Figures{std::move(figure)}) {}

  SpringGoal& add(const char* segment, Spring spring, double weight = 10.0, int figure = 0) {
    goals.push_back(goal_at(*figures[static_cast<std::size_t>(figure)], segment, std::move(spring), weight));
    goals.back().figure = figure;
    return goals.back();
  }
  SpringGoal& pull(const char* segment, const Vec3& target, double weight = 10.0) {
    return add(segment, PositionSpring{target}, weight);
  }
  SpringPose solve(const std::function<bool()>& should_stop = {}) {
    SpringPose out;
    out.q = start;
    solver.solve(goals, options, should_stop, out);
    return out;
  }
  // Where a touch point is at the start.
  Vec3 touch(const char* segment) {
    SpringBench nothing(figures);
    nothing.start = start;
    const AttachedPoint at = figures[0]->attach({segment, {}, ""}).value();
    return nothing.solve().world_from_segment[0][static_cast<std::size_t>(at.segment)] * at.point;
  }
  double error(const SpringPose& pose, std::size_t goal) const {
    const SquareError e = square_error(figures, goals[goal], pose.q);
    return std::sqrt(e.place + e.turn);
  }
  double unbalance(const SpringPose& pose) const { return test::unbalance(figures, goals, pose.q); }
  double cost(const AllQ& q) const { return cost_of(figures, goals, q); }
};

inline bool same_bytes(const AllQ& a, const AllQ& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& one, const auto& other) { return same_bytes(one, other); });
}

inline double worst_limit(const Figures& figures, const AllQ& q) {
  double worst = 0.0;
  for (std::size_t f = 0; f < figures.size(); ++f) worst = std::max(worst, beyond_limits(*figures[f], q[f]));
  return worst;
}

}  // namespace posed::test
