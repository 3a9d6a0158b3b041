// Goals in their order of priority: those of lower numbers are met first, and the later ones may move them no more.
//
// A level that has been balanced is held by the method of multipliers: stiff springs that pull not to the goals but to
// the errors that were left, shifted until they stay there. So each level is a balance of springs like any other.
#include <algorithm>
#include <cmath>

#include "server/solver/springs/explain.h"
#include "server/solver/springs/spring_solver.h"

namespace posed {

using springs::Term;

namespace {

constexpr double kStiff = 1e4;       // against the heaviest goal of the level
constexpr double kHeldPlace = 1e-8;  // m
constexpr int kRounds = 6;

}  // namespace

void SpringSolver::balance_levels(std::span<const SpringGoal> goals, const SpringOptions& options,
                                  const Stop& should_stop, SolveReport& report) {
  const auto level_of = [&](const Term& term) { return goals[static_cast<std::size_t>(term.goal)].priority; };
  SpringOptions now = options;
  for (const int level : levels_) {
    set_springs(goals, &level);
    double heaviest = 0.0;
    for (const SpringGoal& goal : goals) {
      if (goal.priority == level && pulls(goal)) heaviest = std::max(heaviest, goal.weight);
    }
    for (const Term& term : terms_) {
      if (level_of(term) == level) heaviest = std::max(heaviest, term.weight);
    }
    bool holds = false;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      Term& term = plan_.terms[i];
      const int own = level_of(terms_[i]);
      term.weight = own > level ? 0.0 : terms_[i].weight;
      if (own >= level || terms_[i].weight <= 0.0) continue;
      holds = true;
      term.weight = kStiff * std::max(heaviest, 1e-6);
      // What was left; an inequality that was met has room.
      for (std::size_t k = 0; k < 3; ++k) term.shift[k] = counted(terms_[i].sense, held_[i].left[k]);
    }
    for (int round = 0; round < kRounds; ++round) {
      balance(now, should_stop, report);
      now.cold = now.explore = false;
      if (!holds || report.status == SolveStatus::deadline || !shift_held(goals, level)) break;
    }
    // What this level could not meet is what the next must keep.
    explainer_->probe().place(plan_, state_);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (level_of(terms_[i]) == level) held_[i].left = explainer_->probe().errors(plan_, terms_[i]).error;
    }
    if (report.status == SolveStatus::deadline) break;
    for (const SpringGoal& goal : goals) {
      if (goal.priority == level && pulls(goal) && std::holds_alternative<PostureSpring>(goal.spring))
        hold_joints(goal);
    }
  }
  // As they are told about.
  set_springs(goals);
  set_bounds(options);
}

// Moves the springs' rest by what they gave way. False where none did.
bool SpringSolver::shift_held(std::span<const SpringGoal> goals, int level) {
  explainer_->probe().place(plan_, state_);
  bool moved = false;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    Term& term = plan_.terms[i];
    if (goals[static_cast<std::size_t>(term.goal)].priority >= level || terms_[i].weight <= 0.0) continue;
    const springs::TermErrors errors = explainer_->probe().errors(plan_, terms_[i]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(errors.count); ++k) {
      const double left = counted(term.sense, held_[i].left[k]);
      const double gave = counted(term.sense, errors.error[k] - left);
      if (std::abs(gave) > kHeldPlace) moved = true;
      term.shift[k] = left - counted(term.sense, errors.error[k] - term.shift[k]);
    }
  }
  return moved;
}

}  // namespace posed
