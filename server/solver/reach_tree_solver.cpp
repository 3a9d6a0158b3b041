#include "server/solver/reach_tree_solver.h"

#include <cassert>
#include <limits>

#include "server/solver/goal_report.h"
#include "server/solver/kinematics.h"

// Figure 17 was read past its misprints:
// - node->goal.weight and node->btinode: node->btnode->goal, node->btnode;
// - joint.matrix: the joint's global matrix, since a goal's location is in world coordinates;
// - node->son.stwd, node->son.stweight: son[i], the i of the loop;
// - "for (i = 0 to numsons)": sons are numbered 0 to numsons - 1;
// - "} n times or until (...)": the braces do not pair; the loop is repeat { ... } until;
// - the global matrices are never computed anew after a chain is solved, nor after the root is moved: refresh() does;
// - it moves first and tests afterwards, so that a tree that rests is moved once in vain and a step that loses is kept.
//   The text's list tests before it moves ("zero magnitude or no smaller than previous iteration"): that is done here,
//   and a step that did not gain is undone. At the root that rule alone would quit too soon, see balance_root;
// - a branch node that holds no goal adds weight 0, and its touch point is what is placed.

namespace posed {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// m. Of balance_error's denominator: where every goal is as good as reached, a share of the pulls would be one of
// nothing.
constexpr double kLeastMiss = 1e-6;

// m. A node whose goals are off by less on the weighted mean is left where it is.
constexpr double kRest = 1e-12;

// Passes at the root without gain after which it stalls.
constexpr int kPatience = 10;

}  // namespace

ReachTreeSolver::ReachTreeSolver(std::shared_ptr<const BodyTree> tree)
    : tree_(std::move(tree)),
      pose_(*tree_, reach_),
      active_(at(tree_->size()), 0),
      wanted_(active_),
      node_of_segment_(at(tree_->size()), -1) {}

void ReachTreeSolver::prepare(std::span<const ReachGoal> goals) {
  std::fill(wanted_.begin(), wanted_.end(), char{0});
  for (const ReachGoal& goal : goals) {
    if (pull_of(goal) > 0.0) wanted_[at(goal.segment)] = 1;
  }
  if (prepared_ && wanted_ == active_) return;
  prepared_ = true;
  active_ = wanted_;
  const bool any = std::find(active_.begin(), active_.end(), char{1}) != active_.end();
  builder_.build(tree_->parents(), active_, any && !tree_->root_is_free(), reach_);
  pose_.resize();
  loads_.resize(reach_.nodes.size());
  std::fill(node_of_segment_.begin(), node_of_segment_.end(), -1);
  for (std::size_t n = 0; n < reach_.nodes.size(); ++n) {
    node_of_segment_[at(reach_.nodes[n].segment)] = static_cast<int>(n);
  }
}

void ReachTreeSolver::solve(std::span<double> q, std::span<const ReachGoal> goals, const ReachTreeOptions& options,
                            const std::function<bool()>& should_stop, Pose& out) {
  assert(static_cast<int>(q.size()) == tree_->q_size());
  prepare(goals);
  options_ = options;
  chain_solves_ = iterations_ = 0;
  out.report = SolveReport{};
  out.world_from_segment.resize(active_.size());
  normalise_quaternions(*tree_, q);
  out.q.assign(q.begin(), q.end());
  forward_kinematics(*tree_, q, out.world_from_segment);

  if (!reach_.nodes.empty()) {
    pose_.begin(q, out.world_from_segment);
    load_goals(goals);
    out.report.status =
        tree_->root_is_free() ? balance_root(goals, should_stop) : balance_below_fixed_root(should_stop);
    out.report.balance_error = sum(goals).balance_error;
  }

  keep_signs(*tree_, out.q, q);
  out.q.assign(q.begin(), q.end());
  forward_kinematics(*tree_, q, out.world_from_segment);
  report_goals(*tree_, reach_, node_of_segment_, goals, out.world_from_segment, out.goals);
  for (std::size_t i = 0; i < goals.size(); ++i) {
    out.report.cost += pull_of(goals[i]) * out.goals[i].error * out.goals[i].error;
  }
  out.report.iterations = iterations_;
  out.report.chain_solves = chain_solves_;
}

void ReachTreeSolver::load_goals(std::span<const ReachGoal> goals) {
  heaviest_ = 0.0;
  for (const ReachGoal& goal : goals) heaviest_ = std::max(heaviest_, pull_of(goal));
  for (std::size_t n = 0; n < loads_.size(); ++n) {
    loads_[n] = Load{};
    loads_[n].point = tree_->segment(reach_.nodes[n].segment).touch_point;
  }
  double farthest = 1.0;
  for (const ReachGoal& goal : goals) {
    const double weight = pull_of(goal) / heaviest_;
    if (!(weight > 0.0)) continue;
    const Vec3 target = target_of(goal);
    Load& load = loads_[at(node_of_segment_[at(goal.segment)])];
    if (load.weight == 0.0) load.point = goal.point, load.target = target;
    load.weight += weight;
    const double share = weight / load.weight;
    load.point += (goal.point - load.point) * share;
    load.target += (target - load.target) * share;
    farthest = std::max({farthest, std::abs(target.x), std::abs(target.y), std::abs(target.z)});
  }
  rest_ = std::max(kRest, 8.0 * std::numeric_limits<double>::epsilon() * farthest);
}

// Below the root each node moves but a few times a pass, so while it settles the root's displacement may grow for some
// passes although all goals come nearer. A pass gains if either the displacement or the cost is the least so far.
SolveStatus ReachTreeSolver::balance_root(std::span<const ReachGoal> goals, const std::function<bool()>& should_stop) {
  const ReachNode& node = reach_.nodes[0];
  Load& root = loads_[0];
  balance_sons(0);
  measure(0);
  Sums sums = sum(goals);
  double least_stwd = glm::length(root.stwd), least_cost = sums.cost;
  Load gained = root;
  std::size_t mark = pose_.save(node);
  int lost = 0;  // passes since
  SolveStatus status = SolveStatus::converged;
  while (!rests(0) && sums.balance_error > options_.balance_tolerance) {
    status = SolveStatus::stalled;
    if (lost > kPatience || iterations_ >= options_.root_iterations || spent()) break;
    if (should_stop && should_stop()) {
      status = SolveStatus::deadline;
      break;
    }
    status = SolveStatus::converged;
    ++iterations_;
    pose_.translate(root.stwd / root.stweight);
    balance_sons(0);
    measure(0);
    sums = sum(goals);
    const double stwd = glm::length(root.stwd);
    ++lost;
    if (stwd < least_stwd || sums.cost < least_cost) {
      lost = 0;
      gained = root;
      pose_.drop(mark);
      mark = pose_.save(node);
    }
    least_stwd = std::min(least_stwd, stwd);
    least_cost = std::min(least_cost, sums.cost);
  }
  if (status != SolveStatus::converged && lost > 0) {
    pose_.restore(node, mark);
    root = gained;
  }
  return status;
}

// What its sons pull is borne by whatever holds the root, so no sum has to vanish: each is balanced as well as can be.
SolveStatus ReachTreeSolver::balance_below_fixed_root(const std::function<bool()>& should_stop) {
  double before = std::numeric_limits<double>::infinity();
  while (true) {
    balance_sons(0);
    measure(0);
    double left = 0.0;
    for (int son = reach_.nodes[0].first_son; son >= 0; son = reach_.nodes[at(son)].next_son) {
      left += rests(son) ? 0.0 : glm::length(loads_[at(son)].stwd);
    }
    if (left == 0.0 || left >= before * (1.0 - options_.balance_tolerance)) return SolveStatus::converged;
    if (iterations_ >= options_.root_iterations || spent()) return SolveStatus::stalled;
    if (should_stop && should_stop()) return SolveStatus::deadline;
    ++iterations_;
    before = left;
  }
}

// balance_reach_tree of Figure 17, for a node that hangs on another.
void ReachTreeSolver::balance(int n) {
  const ReachNode& node = reach_.nodes[at(n)];
  Load& load = loads_[at(n)];
  balance_sons(n);
  measure(n);
  for (int i = 0; i < options_.branch_iterations && !rests(n) && !spent(); ++i) {
    const Load before = load;
    const std::size_t mark = pose_.save(node);
    if (pose_.bend_chain(node, load.place, load.place + load.stwd / load.stweight)) ++chain_solves_;
    balance_sons(n);
    measure(n);
    if (glm::length(load.stwd) >= glm::length(before.stwd)) {
      pose_.restore(node, mark);
      load = before;
      return;
    }
    pose_.drop(mark);
  }
}

void ReachTreeSolver::balance_sons(int n) {
  for (int son = reach_.nodes[at(n)].first_son; son >= 0; son = reach_.nodes[at(son)].next_son) balance(son);
}

// get_local_weighted_displacement and the sums of Figure 17, once the sons are balanced.
void ReachTreeSolver::measure(int n) {
  const ReachNode& node = reach_.nodes[at(n)];
  Load& load = loads_[at(n)];
  load.place = pose_.world_point(node.segment, load.point);
  load.stwd = (load.target - load.place) * load.weight;
  load.stweight = load.weight;
  for (int son = node.first_son; son >= 0; son = reach_.nodes[at(son)].next_son) {
    load.stwd += loads_[at(son)].stwd;
    load.stweight += loads_[at(son)].stweight;
  }
}

bool ReachTreeSolver::rests(int n) const {
  const Load& load = loads_[at(n)];
  return glm::length(load.stwd) <= rest_ * load.stweight;
}

bool ReachTreeSolver::spent() const {
  return chain_solves_ >= options_.chain_solve_limit;
}

ReachTreeSolver::Sums ReachTreeSolver::sum(std::span<const ReachGoal> goals) const {
  double pulls = 0.0, weights = 0.0, cost = 0.0;
  for (const ReachGoal& goal : goals) {
    const double weight = pull_of(goal) / heaviest_;
    if (!(weight > 0.0)) continue;
    const double miss = glm::length(target_of(goal) - pose_.world_point(goal.segment, goal.point));
    pulls += weight * miss;
    weights += weight;
    cost += weight * miss * miss;
  }
  return {glm::length(loads_[0].stwd) / std::max(pulls, kLeastMiss * weights), cost};
}

}  // namespace posed
