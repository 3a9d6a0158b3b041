// The springs of single joints: posture goals, and the weak pull back to the start pose on a long way.
#include <algorithm>

#include "server/solver/springs/rests.h"
#include "server/solver/springs/spring_solver.h"

namespace posed {

namespace {

// A share of the goals' weight, rad^2 for m^2.
constexpr double kStartPull = 1e-4;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

void SpringSolver::set_springs(std::span<const SpringGoal> goals, const int* level) {
  plan_.rests.clear();
  for (std::size_t g = 0; g < goals.size(); ++g) {
    const SpringGoal& goal = goals[g];
    const auto* posture = std::get_if<PostureSpring>(&goal.spring);
    if (!posture || !pulls(goal) || (level && goal.priority != *level)) continue;
    const BodyTree& tree = figure(goal.figure);
    std::vector<double>& q = posture_q_[at(goal.figure)];
    std::size_t next = 0;
    for (const int joint : posture->joints) {
      const auto size = at(q_size(tree.joint(joint).type));
      std::copy_n(posture->values.begin() + static_cast<std::ptrdiff_t>(next), size, q.begin() + tree.q_at(joint));
      next += size;
    }
    angles_.read(tree, goal.figure, plan_, q, posture_);
    springs::add_rests(tree, goal, static_cast<int>(g), link_of_segment_[at(goal.figure)], q, posture_, plan_);
  }
  springs::sum_stiffness(plan_);
}

// A posture that has been balanced is left as it is: its joints move no more.
void SpringSolver::hold_joints(const SpringGoal& goal) {
  for (const int joint : std::get<PostureSpring>(goal.spring).joints) {
    springs::Link& link = plan_.links[at(link_of_segment_[at(goal.figure)][at(joint)])];
    if (link.kind == springs::LinkKind::floating) link.pinned = true;
    for (std::size_t j = at(link.dof); j < at(link.dof + link.dofs); ++j)
      plan_.least[j] = plan_.most[j] = state_.turns[j];
  }
}

// Joints that no posture goal holds.
void SpringSolver::hold_to_start() {
  const double strength = kStartPull * weights();
  own_rests_ = plan_.rests.size();
  for (std::size_t f = 0; f < figures_.size(); ++f) {
    std::vector<double>& q = posture_q_[f];
    angles_.write(*figures_[f], static_cast<int>(f), plan_, start_, q);
    for (std::size_t i = 0; i < plan_.links.size(); ++i) {
      const springs::Link& link = plan_.links[i];
      if (link.figure != static_cast<int>(f) || link.dofs == 0 || plan_.stiffness[at(link.dof)] > 0.0) continue;
      springs::Rest rest = springs::rest_at(*figures_[f], plan_, static_cast<int>(i), q, start_);
      for (int k = 0; k < link.dofs; ++k) rest.weight[at(k)] = strength * plan_.dofs[at(link.dof + k)].effort;
      plan_.rests.push_back(rest);
    }
  }
  springs::sum_stiffness(plan_);
}

void SpringSolver::let_go_of_start() {
  plan_.rests.resize(own_rests_);
  springs::sum_stiffness(plan_);
}

}  // namespace posed
