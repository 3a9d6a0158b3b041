// The paper's own solver: balances the reach tree of a figure's position goals (sections "Balanced reach trees" and
// "Reach tree balancing algorithm", Figure 17). It is the reference for every solver after it.
//
// Each goal pulls its point like a spring of the goal's weight. Node by node the simple chain from the parent is bent
// so that the node goes where the pulls of its subtree balance; the reach tree's root is moved by translating the body
// root. The body root never rotates, and nothing above the reach tree's root bends: a lone goal moves the whole figure
// rigidly. A body root whose joint is not free always is the reach tree's root, and stays where it is.
// Ball and universal joints bend as balls, without limits; hinge, prismatic and fixed joints stay as they are.
//
// Convergence slows with the ratio of the weights, as a pass at the root moves it by the weighted mean of all pulls:
// 1 : 10,000 needs thousands of passes. SolveReport::balance_error says how far it came.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/pose.h"
#include "server/solver/body_tree.h"
#include "server/solver/reach_goal.h"
#include "server/solver/reach_pose.h"
#include "server/solver/reach_tree.h"

namespace posed {

struct ReachTreeOptions {
  int root_iterations = 200;        // moves of the reach tree's root at most
  int branch_iterations = 1;        // moves at most of each node below it, every time that it is balanced
  double balance_tolerance = 1e-9;  // of SolveReport::balance_error
  int chain_solve_limit = 200'000;  // goals nested d deep cost 2^d chain solves a pass: here it ends, still with a pose
};

// Owns its scratch memory: one solver a thread.
class ReachTreeSolver {
 public:
  explicit ReachTreeSolver(std::shared_ptr<const BodyTree> tree);
  ReachTreeSolver(const ReachTreeSolver&) = delete;
  ReachTreeSolver& operator=(const ReachTreeSolver&) = delete;

  // Builds the reach tree for the goals that are on. `solve` does it by itself when that set has changed; called ahead,
  // it takes the allocations with it.
  void prepare(std::span<const ReachGoal> goals);

  // q: in, the start pose (see check_q); out, the answer, with quaternions of unit length and of the start's signs.
  // `should_stop` may be empty; it is asked before every pass at the root. `out` gets the pose and its reasons; its
  // memory is reused. Status: converged (balanced to the tolerance; under a root that can not move, no pass gains any
  // more), stalled (a pass gained nothing, or a limit was reached) or deadline.
  // Never throws, and after the first call with the same set of goals it does not allocate. Same input, same bytes.
  // Precondition: goals name segments of the tree and hold finite points.
  void solve(std::span<double> q, std::span<const ReachGoal> goals, const ReachTreeOptions& options,
             const std::function<bool()>& should_stop, Pose& out);

  const BodyTree& tree() const { return *tree_; }
  const ReachTree& reach_tree() const { return reach_; }

 private:
  // A node's share of Figure 14. Its goals pull like one: with their summed weight, at the weighted mean of their
  // points, towards the weighted mean of their targets.
  struct Load {
    Vec3 point{0.0, 0.0, 0.0};   // segment's frame: what is placed; without a goal the touch point
    Vec3 target{0.0, 0.0, 0.0};  // world
    double weight = 0.0;         // share of the heaviest goal's
    Vec3 place{0.0, 0.0, 0.0};   // world: where `point` is (BTNODE::touchpoint)
    Vec3 stwd{0.0, 0.0, 0.0};    // subtree weighted displacement
    double stweight = 0.0;       // total subtree weight
  };

  struct Sums {
    double balance_error = 0.0;  // as in SolveReport
    double cost = 0.0;           // with weights as shares of the heaviest
  };

  void load_goals(std::span<const ReachGoal> goals);
  SolveStatus balance_root(std::span<const ReachGoal> goals, const std::function<bool()>& should_stop);
  SolveStatus balance_below_fixed_root(const std::function<bool()>& should_stop);
  void balance(int node);
  void balance_sons(int node);
  void measure(int node);
  bool rests(int node) const;
  bool spent() const;
  Sums sum(std::span<const ReachGoal> goals) const;

  std::shared_ptr<const BodyTree> tree_;
  ReachTreeBuilder builder_;
  ReachTree reach_;
  ReachPose pose_;
  bool prepared_ = false;
  std::vector<char> active_;          // segments that hold a goal that is on
  std::vector<char> wanted_;          // the same, of the goals at hand
  std::vector<int> node_of_segment_;  // or -1
  std::vector<Load> loads_;           // of the nodes

  // Of the solve under way.
  ReachTreeOptions options_;
  double heaviest_ = 1.0;
  double rest_ = 0.0;  // m; a displacement below it is none
  int chain_solves_ = 0;
  int iterations_ = 0;
};

}  // namespace posed
