#include "server/solver/springs/explain.h"

#include <algorithm>
#include <cmath>

namespace posed::springs {
namespace {

double length(std::span<const double> v) {
  double sum = 0.0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

// Four sums side by side: one alone would wait for each addition.
double dot(const double* a, const double* b, std::size_t n) {
  double sum[4] = {0.0, 0.0, 0.0, 0.0};
  std::size_t j = 0;
  for (; j + 4 <= n; j += 4) {
    for (std::size_t k = 0; k < 4; ++k) sum[k] += a[j + k] * b[j + k];
  }
  for (; j < n; ++j) sum[0] += a[j] * b[j];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

Cause::Side side_of(Probe::Bound bound) {
  return bound == Probe::Bound::max   ? Cause::Side::max
         : bound == Probe::Bound::min ? Cause::Side::min
                                      : Cause::Side::swing;
}

}  // namespace

void Explainer::prepare(const Plan& plan, std::size_t goals) {
  probe_.prepare(plan);
  dofs_ = plan.dofs.size();
  slopes_.resize(goals * dofs_);
  total_.resize(dofs_);
  sprung_.resize(dofs_);
  costs_.resize(goals);
  apart_.resize(goals);
  bounds_.resize(dofs_);
  pulls_.reserve(goals);
  felt_.resize(goals * (dofs_ / 4 + 1));
  following_.resize(dofs_);
  felt_from_.resize(goals + 1);
}

double Explainer::explain(const Plan& plan, std::span<const SpringGoal> goals,
                          const std::vector<std::vector<int>>& link_of_segment, const State& state,
                          std::vector<GoalReport>& out) {
  out.resize(goals.size());
  probe_.place(plan, state);
  std::fill(slopes_.begin(), slopes_.end(), 0.0);
  std::fill(total_.begin(), total_.end(), 0.0);
  for (GoalReport& report : out) {
    report.error = 0.0;
    report.force = report.touch = report.target = kZero;
    report.state = GoalState::off;
    report.causes.clear();
    report.causes.reserve(kMostCauses + 4);
  }
  std::fill(costs_.begin(), costs_.end(), 0.0);
  std::fill(apart_.begin(), apart_.end(), 0.0);
  for (const Term& term : plan.terms) {
    const auto g = static_cast<std::size_t>(term.goal);
    report(plan, term, goals[g], out[g]);
    if (term.weight > 0.0) probe_.pull(plan, term, slope(g));
  }
  for (std::size_t g = 0; g < goals.size(); ++g) {
    if (std::holds_alternative<PostureSpring>(goals[g].spring) && pulls(goals[g]))
      report_posture(plan, goals[g], g, link_of_segment[static_cast<std::size_t>(goals[g].figure)][0], out[g]);
  }
  double scale = 0.0, most = 0.0;
  for (std::size_t g = 0; g < goals.size(); ++g) {
    for (std::size_t j = 0; j < dofs_; ++j) total_[j] += slope(g)[j];
    // At the nearest that it can come a goal alone has no slope left: it is its pull that counts.
    scale = std::max({scale, length(slope(g)), kNoPull * std::sqrt(goals[g].weight * costs_[g])});
  }
  for (std::size_t i = 0; i < plan.links.size(); ++i) {
    const Link& link = plan.links[i];
    for (std::size_t j = link.first_dof(); j < link.end_dof(); ++j) {
      bounds_[j] = probe_.held(plan, state, i, j, total_);
      if (bounds_[j] == Probe::Bound::none && !link.pinned) most = std::max(most, std::abs(total_[j]));
    }
  }
  find_felt(goals.size());
  for (std::size_t g = 0; g < goals.size(); ++g) {
    if (pulls(goals[g])) find_state(plan, goals, g, out);
  }
  double weights = 0.0;
  for (const Term& term : plan.terms) weights += term.weight;
  // Pulls of less than a nanometre are no pulls.
  return most / std::max({scale, 1e-9 * weights, 1e-300});
}

void Explainer::find_felt(std::size_t goals) {
  std::size_t end = 0;
  for (std::size_t g = 0; g < goals; ++g) {
    felt_from_[g] = end;
    const std::span<const double> feels = slope(g);
    for (std::size_t j = 0; j < dofs_; ++j) {
      if (feels[j] == 0.0 || bounds_[j] != Probe::Bound::none) continue;
      // What lies between two that are near counts nothing, but breaks no loop.
      if (end > felt_from_[g] && j < felt_[end - 1].to + 4)
        felt_[end - 1].to = j + 1;
      else
        felt_[end++] = {j, j + 1};
    }
  }
  felt_from_[goals] = end;
}

void Explainer::compare(const SpringGoal& goal, std::size_t index, double error, double reached) {
  apart_[index] = std::max(apart_[index], error / std::max(goal.tolerance.radius, reached));
}

// Error, force, touch and target of one term; a pose goal's second adds to its first.
void Explainer::report(const Plan& plan, const Term& term, const SpringGoal& goal, GoalReport& out) {
  const TermErrors errors = probe_.errors(plan, term);
  double square = 0.0;
  Vec3 error = kZero;
  for (int k = 0; k < errors.count; ++k) {
    const double e = counted(term.sense, errors.error[static_cast<std::size_t>(k)]);
    error[k] = e;
    square += e * e;
  }
  out.error = std::sqrt(out.error * out.error + square);
  const bool is_turn = term.kind == TermKind::turn || term.kind == TermKind::aim;
  costs_[static_cast<std::size_t>(term.goal)] += term.weight * square;
  if (term.weight > 0.0 && term.kind != TermKind::point)
    compare(goal, static_cast<std::size_t>(term.goal), std::sqrt(square),
            is_turn ? kReachedTurn * term.lever : kReachedPlace);
  if (term.kind == TermKind::balance) {
    out.touch = out.target = probe_.centre_of_mass(plan, term.figure);
    return;
  }
  const Transform base = term.base >= 0 ? probe_.link(term.base) : Transform{};
  const Vec3 touch = probe_.point(term.link, term.point);
  const Vec3 place = base * term.place, way = base.rotation * term.direction;
  switch (term.kind) {
    case TermKind::point: {
      out.target = place;
      const Quat& axes = term.base >= 0 ? base.rotation : goal.world_from_base.rotation;
      double& apart = apart_[static_cast<std::size_t>(term.goal)];
      if (term.weight > 0.0)
        apart = std::max(apart, over_tolerance(goal.tolerance, glm::conjugate(axes) * (touch - place), kReachedPlace));
      break;
    }
    case TermKind::plane:
      out.target = touch - way * error.x;
      break;
    case TermKind::line:
      out.target = place + way * glm::dot(touch - place, way);
      break;
    case TermKind::distance: {
      const double apart = glm::length(touch - place);
      out.target = apart > 0.0 ? touch - (touch - place) * (error.x / apart) : touch;
      break;
    }
    case TermKind::aim:
      out.target = term.at_point ? place : touch + way * term.lever;
      break;
    case TermKind::turn:
    case TermKind::balance:
      if (!std::holds_alternative<PoseSpring>(goal.spring)) out.target = touch;
      break;
  }
  out.touch = touch;
  if (!is_turn) out.force = (out.target - touch) * term.weight;
  if (term.kind == TermKind::turn && !std::holds_alternative<PoseSpring>(goal.spring)) out.force = -error * term.weight;
}

void Explainer::report_posture(const Plan& plan, const SpringGoal& goal, std::size_t index, int root, GoalReport& out) {
  double square = 0.0;
  for (const Rest& rest : plan.rests) {
    if (rest.goal != static_cast<int>(index)) continue;
    const Link& link = plan.links[static_cast<std::size_t>(rest.link)];
    if (link.dofs == 0) continue;
    const std::size_t first = link.first_dof();
    std::fill_n(sprung_.begin() + static_cast<std::ptrdiff_t>(first), link.dofs, 0.0);
    // The rest's weight has the lever in it.
    const double cost = probe_.pull(plan, rest, sprung_);
    double off = 0.0;
    for (std::size_t j = first; j < link.end_dof(); ++j) {
      off = std::max(off, std::abs(sprung_[j] / rest.weight[j - first]));
      slope(index)[j] += sprung_[j];
    }
    // A limb's degrees of freedom are not at right angles.
    if (link.kind == LinkKind::limb) off = std::sqrt(cost / rest.weight[0]);
    square += cost / goal.weight;
    const bool slides = plan.dofs[first].kind == DofKind::along_axis;
    if (std::sqrt(square) > goal.tolerance.radius) compare(goal, index, off, slides ? kReachedPlace : kReachedTurn);
  }
  out.error = std::sqrt(square);
  costs_[index] = goal.weight * square;
  if (root >= 0) out.touch = out.target = probe_.point(root, kZero);
}

void Explainer::find_state(const Plan& plan, std::span<const SpringGoal> goals, std::size_t index,
                           std::vector<GoalReport>& out) {
  GoalReport& report = out[index];
  const SpringGoal& goal = goals[index];
  report.state = GoalState::reached;
  if (apart_[index] <= 1.0) return;
  double held = 0.0, free = 0.0;
  for (std::size_t j = 0; j < dofs_; ++j) {
    const double s = slope(index)[j];
    // It is the sum of all pulls that a limit stands against; this goal's share counts where it pushes the same way.
    const bool limit = bounds_[j] != Probe::Bound::none && s * total_[j] > 0.0;
    (limit ? held : free) += s * s;
  }
  held = std::sqrt(held), free = std::sqrt(free);
  const bool is_pose = std::holds_alternative<PoseSpring>(goal.spring);
  const double whole = (is_pose ? std::max(goal.weight, goal.orientation_weight) : goal.weight) * report.error;
  if (free <= kNoPull * whole)
    report.state = GoalState::unreachable;
  else
    report.state = held > free ? GoalState::limited : GoalState::balanced;
  name_causes(plan, goals, index, held, out);
  if (report.state == GoalState::unreachable && held <= kNoPull * whole &&
      (is_pose || std::holds_alternative<PositionSpring>(goal.spring))) {
    Cause beyond;
    beyond.kind = Cause::Kind::beyond;
    beyond.beyond_m = glm::length(report.target - report.touch);
    report.causes.push_back(beyond);
  }
}

void Explainer::name_causes(const Plan& plan, std::span<const SpringGoal> goals, std::size_t index,
                            double held_by_limits, std::vector<GoalReport>& out) {
  std::vector<Cause>& causes = out[index].causes;
  const std::span<double> mine = slope(index);
  // Limits that take a tenth of the pull or more.
  for (std::size_t i = 0; i < plan.links.size(); ++i) {
    const Link& link = plan.links[i];
    for (std::size_t j = link.first_dof(); j < link.end_dof(); ++j) {
      const Probe::Bound bound = bounds_[j];
      if (bound == Probe::Bound::none || mine[j] * total_[j] <= 0.0) continue;
      if (std::abs(mine[j]) < 0.1 * held_by_limits || causes.size() >= kMostCauses) continue;
      Cause cause;
      cause.kind = Cause::Kind::limit;
      cause.figure = link.figure;
      cause.joint = link.segment;
      cause.side = side_of(bound);
      causes.push_back(cause);
    }
  }
  // Goals that pull the other way, the strongest first.
  pulls_.clear();
  for (std::size_t j = 0; j < dofs_; ++j) following_[j] = bounds_[j] == Probe::Bound::none ? mine[j] : 0.0;
  for (std::size_t g = 0; g < out.size(); ++g) {
    if (g == index) continue;
    double product = 0.0;
    for (const Range& r : felt(g)) product += dot(&slope(g)[r.from], &following_[r.from], r.to - r.from);
    if (goals[g].priority == kPinPriority && goals[g].at.segment == 0 && pulls(goals[g])) {
      // A root that is pinned whole stands still, so that its pin shows no pull of its own.
      for (const Link& link : plan.links) {
        if (!link.pinned || link.figure != goals[g].figure) continue;
        for (std::size_t j = link.first_dof(); j < link.end_dof(); ++j) product -= mine[j] * mine[j];
      }
    }
    if (product < 0.0) pulls_.push_back({g, -product});
  }
  std::sort(pulls_.begin(), pulls_.end(), [](const Pull& a, const Pull& b) {
    return a.strength != b.strength ? a.strength > b.strength : a.goal < b.goal;
  });
  const double strongest = pulls_.empty() ? 0.0 : pulls_.front().strength;
  for (const Pull& pull : pulls_) {
    if (pull.strength < 0.01 * strongest || causes.size() >= kMostCauses) break;
    Cause cause;
    cause.goal = static_cast<int>(pull.goal);
    causes.push_back(cause);
  }
}

}  // namespace posed::springs
