// Goals in their order of priority: those of lower numbers are met first, and the later ones may move them no more.
//
// A level that has been balanced is held by the method of multipliers. Its springs grow stiffer than those of the next,
// all by the same factor: so their forces stay in balance, and where a limb is stretched towards what it cannot reach
// they keep it so. What they give way under the next level's pull is then made up for by shifting them
// (springs::Term::shift), until they are back where they were. They are not stiff at once, since the way along what
// stiff springs allow is narrow, and takes many short steps.
#include <algorithm>
#include <cmath>

#include "server/solver/springs/explain.h"
#include "server/solver/springs/spring_solver.h"
#include "server/solver/springs/starts.h"

namespace posed {

using springs::Term;
using springs::Tuning;

namespace {

// Of the heaviest goal that is held against the heaviest of the next level, and where the way has led too far aside.
constexpr double kStiff = 30.0, kStifferStart = 30.0;
constexpr int kAttempts = 3;
// Where a limb is stretched to its end, shifts alone do not bring it back: it takes more stiffness, in steps.
constexpr double kStiffer = 10.0, kSlow = 0.25;
constexpr int kStiffenings = 4;
constexpr int kRounds = 12;
// What may be left of what was held, m: at the end, and before the level is tried again; a stream's accuracy allows
// shares of it.
constexpr double kHeldPlace = 1e-8, kHeldShare = 0.02, kLost = 1e-6, kLostShare = 0.5;
// What a round may leave of the cost to the next one, as a share: of the first, against the one before, of the last.
constexpr double kRough = 1e-4, kFiner = 1e-5, kFine = 1e-14, kFineInStream = 1e-6;
constexpr double kRoundDamping = 1e-4;  // a round begins near to where it ends

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
    const bool first = before == 0.0;
    before = heaviest;
    far = (first ? balance(options, should_stop, report) : balance_held(goals, level, options, should_stop, report)) ||
          far;
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

// True: the start was far away.
bool SpringSolver::balance_held(std::span<const SpringGoal> goals, int level, const SpringOptions& options,
                                const Stop& should_stop, SolveReport& report) {
  std::copy(plan_.terms.begin(), plan_.terms.end(), begun_terms_.begin());
  springs::copy(state_, begun_);
  bool far = false;
  double stiffer = 1.0;
  for (int attempt = 1;; ++attempt) {
    rough_ = kRough;
    far = balance(options, should_stop, report) || far;
    const bool held = hold(goals, level, options, should_stop, report);
    rough_ = 0.0;
    if (held || attempt == kAttempts || report.status == SolveStatus::deadline) return far;
    // They gave way so far that no way leads back.
    springs::copy(begun_, state_);
    std::copy(begun_terms_.begin(), begun_terms_.end(), plan_.terms.begin());
    stiffer *= kStifferStart;
    stiffen(goals, level, stiffer);
  }
}

// Goals of levels before this one.
void SpringSolver::stiffen(std::span<const SpringGoal> goals, int level, double factor) {
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    if (goals[static_cast<std::size_t>(terms_[i].goal)].priority < level) plan_.terms[i].weight *= factor;
  }
}

// After a first round, which balance() was. False: they do not come back.
bool SpringSolver::hold(std::span<const SpringGoal> goals, int level, const SpringOptions& options,
                        const Stop& should_stop, SolveReport& report) {
  const double place = std::max(kHeldPlace, kHeldShare * options.accuracy);
  const double lost = std::max(kLost, kLostShare * options.accuracy);
  const double fine = options.accuracy > 0.0 ? kFineInStream : kFine;
  double last = 0.0;
  int stiffenings = 0;
  for (int round = 0;; ++round) {
    if (report.status == SolveStatus::deadline) return true;
    const double gave = shift_held(goals, level);
    if (gave <= place && rough_ <= fine) return true;
    if (round == kRounds) return gave <= lost;
    if (round > 0 && gave > place && gave > kSlow * last) {
      if (stiffenings == kStiffenings && gave > lost) return false;
      if (stiffenings++ < kStiffenings) stiffen(goals, level, kStiffer);
    }
    last = gave;
    rough_ = std::max(rough_ * kFiner, fine);
    Tuning near = tuning(options);
    near.second_order = true;
    near.damping = kRoundDamping;
    descend(near, should_stop, report);
  }
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
