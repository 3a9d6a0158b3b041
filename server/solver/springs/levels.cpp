// Goals in their order of priority: those of lower numbers are met first, and the later ones may move them no more.
//
// A level that has been balanced is held by the method of multipliers. Its springs grow stiffer, all by the same
// factor: so their forces stay in balance, and where a limb is stretched towards what it cannot reach they keep it so.
// What they give way under the next level's pull is then made up for by shifting them (springs::Term::shift), until
// they are back where they were.
#include <algorithm>
#include <cmath>

#include "server/solver/springs/explain.h"
#include "server/solver/springs/spring_solver.h"

namespace posed {

using springs::Term;

namespace {

// Where a limb is stretched to its end, shifts alone do not bring it back: it takes more stiffness, in steps.
constexpr double kStiffer = 10.0, kSlow = 0.25;
constexpr int kStiffenings = 2;
constexpr double kHeldPlace = 1e-8;  // m
constexpr int kRounds = 12;

}  // namespace

void SpringSolver::balance_levels(std::span<const SpringGoal> goals, const SpringOptions& options,
                                  const Stop& should_stop, SolveReport& report) {
  SpringOptions now = options;
  now.cold = now.explore = false;
  if (options.cold) {
    search_levels(goals, options, should_stop, report);
    begin_levels(goals, options);
  }
  const bool far = take_levels(goals, now, should_stop, report);
  if (options.explore && !options.cold && far && report.status != SolveStatus::deadline)
    explore_levels(goals, now, should_stop, report);
}

double SpringSolver::heaviest(std::span<const SpringGoal> goals, int level) {
  double most = 1e-6;
  for (const SpringGoal& goal : goals) {
    if (goal.priority == level && pulls(goal)) most = std::max(most, goal.weight);
  }
  return most;
}

// As a solve begins: all as the goals say, with nothing held yet.
void SpringSolver::begin_levels(std::span<const SpringGoal> goals, const SpringOptions& options) {
  std::copy(terms_.begin(), terms_.end(), plan_.terms.begin());
  set_springs(goals);
  set_bounds(options);
  pin_roots(goals);
}

bool SpringSolver::take_levels(std::span<const SpringGoal> goals, const SpringOptions& options, const Stop& should_stop,
                               SolveReport& report) {
  const auto level_of = [&](const Term& term) { return goals[static_cast<std::size_t>(term.goal)].priority; };
  bool far = false;
  double before = 0.0;  // the heaviest goal of the level before
  for (Term& term : plan_.terms) term.weight = 0.0;
  for (const int level : levels_) {
    set_springs(goals, &level);
    const double heaviest = SpringSolver::heaviest(goals, level);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (level_of(terms_[i]) == level)
        plan_.terms[i].weight = terms_[i].weight;
      else
        plan_.terms[i].weight *= before > 0.0 ? kStiff * heaviest / before : 0.0;
    }
    const bool holds = before > 0.0;
    before = heaviest;
    double last = 0.0;
    int stiffenings = 0;
    for (int round = 0; round < kRounds; ++round) {
      if (round == 0)
        far = balance(options, should_stop, report) || far;
      else
        descend(tuning(options), should_stop, report);
      if (!holds || report.status == SolveStatus::deadline) break;
      const double gave = shift_held(goals, level);
      if (gave <= kHeldPlace) break;
      if (round > 0 && gave > kSlow * last && stiffenings++ < kStiffenings) {
        for (std::size_t i = 0; i < terms_.size(); ++i) {
          if (level_of(terms_[i]) < level) plan_.terms[i].weight *= kStiffer;
        }
      }
      last = gave;
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
  return far;
}

// Shifts the springs by what they gave way, m; returns the most.
double SpringSolver::shift_held(std::span<const SpringGoal> goals, int level) {
  explainer_->probe().place(plan_, state_);
  double most = 0.0;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    Term& term = plan_.terms[i];
    if (goals[static_cast<std::size_t>(term.goal)].priority >= level || terms_[i].weight <= 0.0) continue;
    const springs::TermErrors errors = explainer_->probe().errors(plan_, terms_[i]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(errors.count); ++k) {
      const double left = counted(term.sense, held_[i].left[k]);
      const double gave = counted(term.sense, errors.error[k] - left);
      most = std::max(most, std::abs(gave));
      // A one-sided spring that does not pull now has no shift to keep.
      term.shift[k] = left - counted(term.sense, errors.error[k] - term.shift[k]);
    }
  }
  return most;
}

}  // namespace posed
