// Other starts than the present pose: for a cold solve, and where an edit has led to a valley that may not be the best.
#include <algorithm>

#include "server/solver/springs/explain.h"
#include "server/solver/springs/spring_solver.h"
#include "server/solver/springs/starts.h"

namespace posed {

using springs::Term;
using springs::Tuning;

namespace {

constexpr double kClearlyBetter = 0.7;
constexpr double kCloseEnough = 0.9;  // of the accuracy that is asked for
// What may be lost of an earlier level by the way in which it is held, m (root mean square), and as a share.
constexpr double kHeldRms = 1e-5, kHeldShare = 1e-3;
// Where all are sought at once, a level against the next, and the first against the last.
constexpr double kStiff = 1e3, kMostStiff = 1e6;

}  // namespace

// From the middle of all ranges; where that leads nowhere, from many starts side by side.
void SpringSolver::search(const SpringOptions& options, const Stop& should_stop, SolveReport& report) {
  const double sum = weights(), reached = sum * kReachedRms * kReachedRms;
  springs::copy(state_, origin_);
  springs::place_middle(plan_, starts_[0], state_);
  Tuning t = tuning(options);
  t.by_effort = false;
  t.align = true;
  t.damping = 0.03;
  t.least_damping = 0.01;  // it is a share of the cost, which falls by itself
  t.enough = std::max(t.enough, sum * kCloseEnough * options.accuracy * kCloseEnough * options.accuracy);
  t.patience = 5;
  const springs::Answer first = descend(t, should_stop, report);
  if (first.stopped) return;
  Tuning polish = tuning(options);
  polish.by_effort = false;
  polish.damping = 1e-3;
  if (cost_ <= reached) {
    if (cost_ > t.enough) descend(polish, should_stop, report);
    return;
  }
  const double cost = cost_;
  springs::place_starts(plan_, origin_, starts_, lanes_);
  Tuning many = t;
  many.damping = 0.1;
  many.iterations = std::min(options.iterations, 60);
  many.patience = 8;
  many.patience_gain = 0.2;
  many.enough = std::max(t.enough, sum * 1e-8);
  const springs::Answer found = kernel_->search(plan_, many, should_stop, lanes_);
  report.iterations += found.iterations;
  if (found.cost < cost) springs::copy(lanes_[0], state_);
  descend(polish, should_stop, report);
  if (found.stopped) report.status = SolveStatus::deadline;
}

template <class Other>
void SpringSolver::keep_if_better(SolveReport& report, Other other) {
  springs::copy(state_, kept_);
  const double cost = cost_;
  const SolveStatus status = report.status;
  report.branch_changed = other();
  if (report.branch_changed) return;
  springs::copy(kept_, state_);
  cost_ = cost;
  report.status = status;
}

void SpringSolver::explore(const SpringOptions& options, const Stop& should_stop, SolveReport& report) {
  const double cost = cost_;
  keep_if_better(report, [&] {
    search(options, should_stop, report);
    return cost_ < kClearlyBetter * cost;
  });
}

// All levels at once, the earlier ones by far the stiffer: near to where they end when they are taken one by one.
void SpringSolver::search_levels(std::span<const SpringGoal> goals, const SpringOptions& options,
                                 const Stop& should_stop, SolveReport& report) {
  begin_levels(goals, options);
  double stiff = 1.0;
  for (std::size_t level = levels_.size(); level-- > 0;) {
    if (level + 1 < levels_.size())
      stiff =
          std::min(stiff * kStiff * heaviest(goals, levels_[level + 1]) / heaviest(goals, levels_[level]), kMostStiff);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (goals[static_cast<std::size_t>(terms_[i].goal)].priority == levels_[level])
        plan_.terms[i].weight = stiff * terms_[i].weight;
    }
  }
  search(options, should_stop, report);
}

void SpringSolver::explore_levels(std::span<const SpringGoal> goals, const SpringOptions& options,
                                  const Stop& should_stop, SolveReport& report) {
  sum_levels(goals, sums_);
  const auto reached = [](const Level& level) { return level.cost <= level.weight * kReachedRms * kReachedRms; };
  if (std::all_of(sums_.begin(), sums_.end(), reached)) return;
  keep_if_better(report, [&] {
    springs::copy(start_, state_);
    search_levels(goals, options, should_stop, report);
    if (report.status == SolveStatus::deadline) return false;
    begin_levels(goals, options);
    take_levels(goals, options, should_stop, report);
    if (report.status == SolveStatus::deadline) return false;
    sum_levels(goals, other_sums_);
    return clearly_better(other_sums_, sums_);
  });
}

// As its goals stand at state_.
void SpringSolver::sum_levels(std::span<const SpringGoal> goals, std::vector<Level>& levels) {
  std::fill(levels.begin(), levels.end(), Level{});
  const auto level_of = [&](int goal) -> Level& {
    const int priority = goals[static_cast<std::size_t>(goal)].priority;
    return levels[static_cast<std::size_t>(std::lower_bound(levels_.begin(), levels_.end(), priority) -
                                           levels_.begin())];
  };
  springs::Probe& probe = explainer_->probe();
  probe.place(plan_, state_);
  for (const Term& term : terms_) {
    const springs::TermErrors errors = probe.errors(plan_, term);
    Level& level = level_of(term.goal);
    level.weight += term.weight;
    for (std::size_t k = 0; k < static_cast<std::size_t>(errors.count); ++k) {
      const double error = counted(term.sense, errors.error[k]);
      level.cost += term.weight * error * error;
    }
  }
  std::fill(slope_.begin(), slope_.end(), 0.0);
  for (const springs::Rest& rest : plan_.rests) {
    Level& level = level_of(rest.goal);
    level.weight += rest.weight[0];
    level.cost += probe.pull(plan_, rest, slope_);
  }
}

// The first level that differs decides.
bool SpringSolver::clearly_better(std::span<const Level> now, std::span<const Level> before) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double least = now[i].weight * kHeldRms * kHeldRms;
    if (now[i].cost > before[i].cost * (1.0 + kHeldShare) + least) return false;
    if (before[i].cost > now[i].weight * kReachedRms * kReachedRms) {
      if (now[i].cost < kClearlyBetter * before[i].cost) return true;
    }
  }
  return false;
}

}  // namespace posed
