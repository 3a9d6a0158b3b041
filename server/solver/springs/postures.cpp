// The springs of single joints: posture goals, and the weak pull back to the start pose on a long way.
#include <algorithm>

#include "server/solver/springs/explain.h"
#include "server/solver/springs/plan_builder.h"
#include "server/solver/springs/spring_solver.h"

namespace posed {

namespace {

// A share of the goals' weight, rad^2 for m^2.
constexpr double kStartPull = 1e-4;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

// Where two posture goals hold one joint, an axis rests at their weighted mean; a ball at the later one's.
void SpringSolver::set_springs(std::span<const SpringGoal> goals, const int* level) {
  std::fill(plan_.springs.begin(), plan_.springs.end(), springs::Spring1{});
  plan_.sprung = false;
  for (const SpringGoal& goal : goals) {
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
    const double lever = tree.document().lever;
    for (const int joint : posture->joints) {
      const springs::Link& link = plan_.links[at(link_of_segment_[at(goal.figure)][at(joint)])];
      for (std::size_t j = at(link.dof); j < at(link.dof + link.dofs); ++j) {
        const bool slides = plan_.dofs[j].kind == springs::DofKind::along_axis ||
                            (link.kind == springs::LinkKind::floating && j < at(link.dof) + 3);
        const double weight = goal.weight * (slides ? 1.0 : lever * lever);
        springs::Spring1& spring = plan_.springs[j];
        spring.weight += weight;
        spring.turn += (posture_.turns[j] - spring.turn) * (weight / spring.weight);
      }
      if (link.kind != springs::LinkKind::axes && link.kind != springs::LinkKind::fixed) rest_quaternion(tree, link, q);
    }
    plan_.sprung = true;
  }
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

// As in q: quaternions of balls and limbs, place and quaternion of roots.
void SpringSolver::rest_quaternion(const BodyTree& tree, const springs::Link& link, std::span<const double> q) {
  const auto size = q_size(tree.joint(link.segment).type);
  std::copy_n(q.begin() + tree.q_at(link.segment), size, plan_.spring_more.begin() + link.more);
}

void SpringSolver::hold_to_start() {
  const double strength = kStartPull * weights();
  std::copy(plan_.springs.begin(), plan_.springs.end(), own_springs_.begin());
  std::copy(plan_.spring_more.begin(), plan_.spring_more.end(), own_more_.begin());
  own_sprung_ = plan_.sprung;
  plan_.sprung = true;
  for (std::size_t f = 0; f < figures_.size(); ++f) {
    std::vector<double>& q = posture_q_[f];
    angles_.write(*figures_[f], static_cast<int>(f), plan_, start_, q);
    for (const springs::Link& link : plan_.links) {
      if (link.figure != static_cast<int>(f)) continue;
      const bool held = link.dofs > 0 && own_sprung_ && own_springs_[at(link.dof)].weight > 0.0;
      if (held) continue;  // a posture goal has its own
      for (std::size_t j = at(link.dof); j < at(link.dof + link.dofs); ++j)
        plan_.springs[j] = {strength * plan_.dofs[j].effort, start_.turns[j]};
      if (link.kind != springs::LinkKind::axes && link.kind != springs::LinkKind::fixed)
        rest_quaternion(*figures_[f], link, q);
    }
  }
}

void SpringSolver::let_go_of_start() {
  std::copy(own_springs_.begin(), own_springs_.end(), plan_.springs.begin());
  std::copy(own_more_.begin(), own_more_.end(), plan_.spring_more.begin());
  plan_.sprung = own_sprung_;
}

}  // namespace posed
