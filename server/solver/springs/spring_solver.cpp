#include "server/solver/springs/spring_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "server/solver/kinematics.h"
#include "server/solver/springs/explain.h"
#include "server/solver/springs/plan_builder.h"
#include "server/solver/springs/starts.h"
#include "server/solver/springs/sweeps.h"
#include "server/solver/springs/terms.h"

namespace posed {

using springs::Tuning;

namespace {

constexpr double kFar = 0.02;  // m, weighted RMS: a start from farther away takes the long way (go_far)
constexpr double kNoBound = 1e9;
constexpr double kBalance = 1e-5;         // SolveReport::balance_error
constexpr double kReachedExactly = 1e-6;  // m, weighted RMS
constexpr double kOutside = 1e-10;        // rad or m beyond a limit that are a matter of rounding

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

// What the layout depends on.
struct SpringSolver::Signature {
  bool pulls = false;
  std::size_t kind = 0;
  int figure = 0, segment = 0, base_figure = 0, base_segment = -1, priority = 0;
  std::vector<int> others;  // segments of the other end or of the support; joints

  static std::vector<int> others_of(const SpringGoal& goal) {
    std::vector<int> all;
    if (const auto* d = std::get_if<DistanceSpring>(&goal.spring)) all.push_back(d->to.segment);
    if (const auto* p = std::get_if<PostureSpring>(&goal.spring)) all = p->joints;
    if (const auto* b = std::get_if<BalanceSpring>(&goal.spring)) {
      for (const AttachedPoint& a : b->support) all.push_back(a.segment);
    }
    return all;
  }
  explicit Signature(const SpringGoal& goal)
      : pulls(posed::pulls(goal)),
        kind(goal.spring.index()),
        figure(goal.figure),
        segment(goal.at.segment),
        base_figure(goal.base_figure),
        base_segment(goal.base_segment),
        priority(goal.priority),
        others(others_of(goal)) {}

  bool fits(const SpringGoal& goal) const {
    if (pulls != posed::pulls(goal)) return false;
    if (!pulls) return true;
    if (kind != goal.spring.index() || figure != goal.figure || segment != goal.at.segment ||
        base_figure != goal.base_figure || base_segment != goal.base_segment || priority != goal.priority) {
      return false;
    }
    if (const auto* d = std::get_if<DistanceSpring>(&goal.spring)) return others[0] == d->to.segment;
    if (const auto* p = std::get_if<PostureSpring>(&goal.spring)) return others == p->joints;
    if (const auto* b = std::get_if<BalanceSpring>(&goal.spring)) {
      return std::equal(others.begin(), others.end(), b->support.begin(), b->support.end(),
                        [](int held, const AttachedPoint& a) { return held == a.segment; });
    }
    return true;
  }
};

SpringSolver::SpringSolver(std::vector<std::shared_ptr<const BodyTree>> figures)
    : figures_(std::move(figures)),
      kernel_(springs::make_kernel()),
      explainer_(std::make_unique<springs::Explainer>()),
      link_of_segment_(figures_.size()),
      whole_(figures_.size()) {
  for (std::size_t f = 0; f < figures_.size(); ++f) {
    const std::vector<char> all(at(figures_[f]->size()), 1);
    std::vector<int> links;
    springs::add_figure(*figures_[f], static_cast<int>(f), all, whole_[f].plan, links);
    springs::resize(whole_[f].plan, whole_[f].state);
    springs::resize(whole_[f].plan, whole_[f].inside);
    whole_[f].angles.resize(whole_[f].plan);
  }
}

SpringSolver::SpringSolver(std::shared_ptr<const BodyTree> figure)
    : SpringSolver(std::vector<std::shared_ptr<const BodyTree>>{std::move(figure)}) {}

SpringSolver::~SpringSolver() = default;

void SpringSolver::prepare(std::span<const SpringGoal> goals) {
  const auto fits = [](const Signature& s, const SpringGoal& g) { return s.fits(g); };
  if (prepared_ && std::equal(signatures_.begin(), signatures_.end(), goals.begin(), goals.end(), fits)) return;
  signatures_.clear();
  for (const SpringGoal& goal : goals) signatures_.emplace_back(goal);
  plan_ = {};
  terms_.clear();
  levels_.clear();
  std::vector<std::vector<char>> active;
  for (const auto& figure : figures_) active.emplace_back(at(figure->size()), 0);
  for (const SpringGoal& goal : goals) {
    if (pulls(goal)) springs::mark_active(goal, figures_, active);
  }
  for (std::size_t f = 0; f < figures_.size(); ++f) {
    springs::add_figure(*figures_[f], static_cast<int>(f), active[f], plan_, link_of_segment_[f]);
  }
  for (std::size_t g = 0; g < goals.size(); ++g) {
    if (!pulls(goals[g])) continue;
    springs::add_terms(goals[g], static_cast<int>(g), figures_, link_of_segment_, plan_, terms_);
    levels_.push_back(goals[g].priority);
  }
  std::sort(levels_.begin(), levels_.end());
  levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
  plan_.terms = begun_terms_ = terms_;
  for (springs::State* state : {&state_, &start_, &kept_, &origin_, &posture_, &begun_}) springs::resize(plan_, *state);
  angles_.resize(plan_);
  std::size_t rests = plan_.links.size();
  for (const SpringGoal& goal : goals) {
    if (const auto* posture = std::get_if<PostureSpring>(&goal.spring)) rests += posture->joints.size();
  }
  plan_.rests.reserve(rests);
  posture_q_.clear();
  for (const auto& figure : figures_) posture_q_.push_back(figure->rest());
  starts_ = springs::make_starts(plan_);
  lanes_.assign(starts_.begin(), starts_.begin() + springs::kStarts);
  held_.resize(terms_.size());
  sums_.resize(levels_.size());
  other_sums_.resize(levels_.size());
  slope_.resize(plan_.dofs.size());
  kernel_->prepare(plan_);
  explainer_->prepare(plan_, goals.size());
  prepared_ = true;
}

void SpringSolver::solve(std::span<const SpringGoal> goals, const SpringOptions& options, const Stop& should_stop,
                         SpringPose& out) {
  prepare(goals);
  out.report = {};
  out.world_from_segment.resize(figures_.size());
  for (std::size_t f = 0; f < figures_.size(); ++f) {
    assert(static_cast<int>(out.q[f].size()) == figures_[f]->q_size());
    normalise_quaternions(*figures_[f], out.q[f]);
    if (options.accuracy == 0.0) confine_all(f, out.q[f]);  // a stream's next start is an answer, and inside
    angles_.read(*figures_[f], static_cast<int>(f), plan_, out.q[f], state_);
  }
  springs::copy(state_, start_);
  set_bounds(options);
  springs::confine(plan_, state_);
  pin_roots(goals);
  set_terms(goals);
  set_springs(goals);
  springs::copy(state_, start_);

  if (!plan_.links.empty()) {
    if (levels_.size() > 1)
      balance_levels(goals, options, should_stop, out.report);
    else
      balance(options, should_stop, out.report);
  }

  if (options.most_turn < kNoBound) hold_back(options);
  for (std::size_t f = 0; f < figures_.size(); ++f) {
    angles_.write(*figures_[f], static_cast<int>(f), plan_, state_, out.q[f]);
    out.world_from_segment[f].resize(at(figures_[f]->size()));
    springs::place_segments(*figures_[f], out.q[f], out.world_from_segment[f]);
  }
  explain(goals, options, out);
}

void SpringSolver::explain(std::span<const SpringGoal> goals, const SpringOptions& options, SpringPose& out) {
  out.report.cost = cost_;
  if (!options.explain) return;
  std::copy(terms_.begin(), terms_.end(), plan_.terms.begin());
  // What the stream's bound holds back is held by no limit.
  for (std::size_t j = 0; j < plan_.dofs.size(); ++j)
    plan_.least[j] = plan_.dofs[j].min, plan_.most[j] = plan_.dofs[j].max;
  out.report.balance_error = explainer_->explain(plan_, goals, link_of_segment_, state_, out.goals);
  // Steps that gain nothing say little: the slopes say whether it is a balance. Of priorities and of what a stream's
  // bound holds back they do not.
  SolveStatus& status = out.report.status;
  if (status != SolveStatus::deadline && levels_.size() == 1 && options.most_turn >= kNoBound &&
      options.accuracy == 0.0) {
    const bool rests = out.report.balance_error < kBalance || cost_ < weights() * kReachedExactly * kReachedExactly;
    status = rests ? SolveStatus::converged : SolveStatus::stalled;
  }
  out.report.cost = 0.0;
  for (std::size_t g = 0; g < goals.size(); ++g) out.report.cost += explainer_->cost(g);
}

// Joints that no goal moves come inside their limits too. What is inside keeps its bytes.
void SpringSolver::confine_all(std::size_t figure, std::span<double> q) {
  Whole& whole = whole_[figure];
  const int index = static_cast<int>(figure);
  whole.angles.read(*figures_[figure], index, whole.plan, q, whole.state);
  springs::copy(whole.state, whole.inside);
  springs::confine(whole.plan, whole.inside);
  for (std::size_t k = 0; k < whole.plan.dofs.size(); ++k) {
    if (std::abs(whole.state.turns[k] - whole.inside.turns[k]) > kOutside) return write_whole(figure, q);
  }
  for (std::size_t k = 0; k < whole.plan.more; ++k) {
    if (std::abs(whole.state.more[k] - whole.inside.more[k]) > kOutside) return write_whole(figure, q);
  }
}

void SpringSolver::write_whole(std::size_t figure, std::span<double> q) {
  Whole& whole = whole_[figure];
  whole.angles.write(*figures_[figure], static_cast<int>(figure), whole.plan, whole.inside, q);
}

// A stream's bound on the joints' speed is a bound like any other.
void SpringSolver::set_bounds(const SpringOptions& options) {
  for (std::size_t j = 0; j < plan_.dofs.size(); ++j) {
    const springs::Dof& dof = plan_.dofs[j];
    plan_.least[j] = dof.min, plan_.most[j] = dof.max;
    if (dof.kind == springs::DofKind::of_root || options.most_turn >= kNoBound) continue;
    const double turn = std::clamp(start_.turns[j], dof.min, dof.max);
    plan_.least[j] = std::max(dof.min, turn - options.most_turn);
    plan_.most[j] = std::min(dof.max, turn + options.most_turn);
  }
}

// Balls and limbs have no bounds of their own: they are turned back along their way.
void SpringSolver::hold_back(const SpringOptions& options) {
  bool held = false;
  for (const springs::Link& link : plan_.links) held |= springs::hold_back(link, start_, options.most_turn, state_);
  if (!held) return;
  Tuning as_it_is;
  as_it_is.iterations = 1;
  cost_ = kernel_->descend(plan_, as_it_is, {}, state_).cost;
}

void SpringSolver::set_terms(std::span<const SpringGoal> goals) {
  std::size_t next = 0;
  for (const SpringGoal& goal : goals) {
    if (!pulls(goal)) continue;
    if (const auto* balance = std::get_if<BalanceSpring>(&goal.spring)) {
      const auto first = at(terms_[next].first_support);
      for (std::size_t k = 0; k < balance->support.size(); ++k)
        plan_.supports[first + k].point = balance->support[k].point;
    }
    next += springs::update_terms(goal, figures_, std::span(terms_).subspan(next));
  }
  std::copy(terms_.begin(), terms_.end(), plan_.terms.begin());
}

// A root that is pinned whole does not move at all; it stands where its pin says.
void SpringSolver::pin_roots(std::span<const SpringGoal> goals) {
  for (springs::Link& link : plan_.links) link.pinned = false;
  for (const SpringGoal& goal : goals) {
    const auto* pose = std::get_if<PoseSpring>(&goal.spring);
    if (!pose || goal.priority != kPinPriority || goal.at.segment != 0 || goal.base_segment >= 0 || !pulls(goal))
      continue;
    springs::Link& link = plan_.links[at(link_of_segment_[at(goal.figure)][0])];
    if (link.kind != springs::LinkKind::floating) continue;
    link.pinned = true;
    const Quat rotation = glm::normalize(goal.world_from_base.rotation * pose->rotation);
    const Vec3 place = goal.world_from_base * pose->position - rotation * goal.at.point;
    const auto q = xyzw(rotation);
    double* more = state_.more.data() + link.more;
    more[0] = place.x, more[1] = place.y, more[2] = place.z;
    std::copy(q.begin(), q.end(), more + 3);
  }
}

double SpringSolver::weights() const {
  double sum = 0.0;
  // Of what is held for a higher priority the goals' own, which are not as stiff.
  for (std::size_t i = 0; i < terms_.size(); ++i) sum += plan_.terms[i].weight > 0.0 ? terms_[i].weight : 0.0;
  for (const double stiffness : plan_.stiffness) sum += stiffness;
  return sum;
}

Tuning SpringSolver::tuning(const SpringOptions& options) const {
  const double sum = weights(), step = 0.3 * options.accuracy, rest = std::max(0.2 * options.accuracy, 1e-10);
  Tuning t;
  t.by_effort = true;
  t.relative_gain = std::max(options.accuracy > 0.0 ? 1e-6 : 1e-20, rough_);
  t.least_gain = sum * step * step;
  t.enough = sum * rest * rest;
  t.least_cost = sum * 1e-12;
  t.iterations = options.iterations;
  t.most_turn = 1.0;
  return t;
}

springs::Answer SpringSolver::descend(const Tuning& tuning, const Stop& should_stop, SolveReport& report) {
  const springs::Answer answer = kernel_->descend(plan_, tuning, should_stop, state_);
  report.iterations += answer.iterations;
  report.status = answer.stopped   ? SolveStatus::deadline
                  : answer.at_rest ? SolveStatus::converged
                                   : SolveStatus::stalled;
  cost_ = answer.cost;
  return answer;
}

bool SpringSolver::balance(const SpringOptions& options, const Stop& should_stop, SolveReport& report) {
  const double sum = weights();
  if (options.cold) {
    search(options, should_stop, report);
    return true;
  }
  Tuning near = tuning(options);
  near.most_start = sum * kFar * kFar;
  if (!descend(near, should_stop, report).too_far) return false;
  go_far(options, should_stop, report);
  if (options.explore && report.status != SolveStatus::deadline && cost_ > sum * kReachedRms * kReachedRms)
    explore(options, should_stop, report);
  return true;
}

// A goal far away: first held back to the start pose by weak springs, so that of all ways the shortest is found, with
// limbs before the trunk and the trunk before the root. Then without them, from where that led.
void SpringSolver::go_far(const SpringOptions& options, const Stop& should_stop, SolveReport& report) {
  Tuning t = tuning(options);
  springs::bend_straight_limbs(plan_, figures_, state_);
  hold_to_start();
  Tuning held = t;
  held.enough = 0.0, held.relative_gain = 1e-4;
  held.iterations = std::min(options.iterations, 60);
  descend(held, should_stop, report);
  let_go_of_start();
  if (report.status != SolveStatus::deadline) descend(t, should_stop, report);
}

}  // namespace posed
