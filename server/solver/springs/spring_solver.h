// The method "springs": the pose in which the goals' springs and the joints' limits are in balance (paper, "Positioning
// by constraints" and "Extensions"). It minimises the sum of weight x error squared inside the limits, by damped Newton
// steps on the reach tree. Redundancy is settled by the shortest way from the start pose, on which limbs move before
// the trunk and the trunk before the root; nothing else pulls at the pose.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/pose.h"
#include "server/solver/body_tree.h"
#include "server/solver/spring_goal.h"
#include "server/solver/springs/joint_angles.h"
#include "server/solver/springs/kernel.h"
#include "server/solver/springs/plan.h"

namespace posed {

namespace springs {
class Explainer;
}

struct SpringOptions {
  // No start pose is given: q is one start of several, and the best answer wins.
  bool cold = false;
  // Other starts are tried as well, but one wins only where it lowers the cost by more than 30 %
  // (SolveReport::branch_changed).
  bool explore = false;
  int iterations = 200;  // of each descent; a replay's budget
  // Of one solve, rad or m: how far a joint may move from its start, so that streams do not jump. Roots are free.
  double most_turn = 1e9;
  // Where goals can be reached, their places are right to this, m (root mean square, by weight): half a tenth of a
  // millimetre is enough for a stream. 0 goes on until nothing gains.
  double accuracy = 0.0;
  bool explain = true;  // fill the goals' states and causes
};

// One answer for all figures that are solved as one. Memory is reused from solve to solve.
struct SpringPose {
  std::vector<std::vector<double>> q;                      // of each figure
  std::vector<std::vector<Transform>> world_from_segment;  // of each figure
  std::vector<GoalReport> goals;                           // in the order in which they were given
  SolveReport report;  // iterations: Newton steps of all descents; balance_error: of the projected gradient
};

// Owns its scratch memory: one solver a thread.
class SpringSolver {
 public:
  // Figures that goals tie together are solved as one; else there is one.
  explicit SpringSolver(std::vector<std::shared_ptr<const BodyTree>> figures);
  explicit SpringSolver(std::shared_ptr<const BodyTree> figure);
  ~SpringSolver();
  SpringSolver(const SpringSolver&) = delete;
  SpringSolver& operator=(const SpringSolver&) = delete;

  // Lays the reach tree out for these goals. `solve` does it by itself where kinds or places of hold have changed;
  // called ahead, it takes the allocations with it.
  void prepare(std::span<const SpringGoal> goals);

  // `out.q` holds the start poses (see check_q; outside limits is allowed) and gets the answer: inside all limits,
  // quaternions of unit length and of the start's signs. `should_stop` may be empty; it is asked between iterations,
  // and what has been found so far is the answer then (status `deadline`). Never throws; does not allocate once
  // prepared. Same input, same bytes, on one instruction set. Precondition: indices are in range, all numbers are
  // finite.
  void solve(std::span<const SpringGoal> goals, const SpringOptions& options, const std::function<bool()>& should_stop,
             SpringPose& out);

  const BodyTree& figure(int i) const { return *figures_[static_cast<std::size_t>(i)]; }
  const springs::Plan& plan() const { return plan_; }
  const char* instruction_set() const { return kernel_->instruction_set(); }

 private:
  using Stop = std::function<bool()>;
  struct Signature;
  struct Held {
    std::array<double, 3> left{0.0, 0.0, 0.0};  // errors that a level of higher priority could not meet
  };

  struct Level {
    double weight = 0.0, cost = 0.0;  // sums over its goals
  };
  static constexpr double kReachedRms = 1e-3;  // m, weighted: better is no other start than what reaches this
  static double heaviest(std::span<const SpringGoal> goals, int level);
  static bool clearly_better(std::span<const Level> now, std::span<const Level> before);

  struct Whole {  // a figure with all its joints
    springs::Plan plan;
    springs::State state, inside;
    springs::JointAngles angles;
  };

  // What a solve is given.
  void confine_all(std::size_t figure, std::span<double> q);
  void write_whole(std::size_t figure, std::span<double> q);
  void set_bounds(const SpringOptions& options);
  void hold_back(const SpringOptions& options);
  void set_terms(std::span<const SpringGoal> goals);
  void pin_roots(std::span<const SpringGoal> goals);
  void set_springs(std::span<const SpringGoal> goals, const int* level = nullptr);  // null: of all levels
  void hold_joints(const SpringGoal& posture);
  void hold_to_start();
  void let_go_of_start();
  double weights() const;
  springs::Tuning tuning(const SpringOptions& options) const;

  // Ways to the balance, from state_ to state_. True: the start was far away.
  void balance_levels(std::span<const SpringGoal> goals, const SpringOptions& options, const Stop& should_stop,
                      SolveReport& report);
  void begin_levels(std::span<const SpringGoal> goals, const SpringOptions& options);
  bool take_levels(std::span<const SpringGoal> goals, const SpringOptions& options, const Stop& should_stop,
                   SolveReport& report);
  void explore_levels(std::span<const SpringGoal> goals, const SpringOptions& options, const Stop& should_stop,
                      SolveReport& report);
  void search_levels(std::span<const SpringGoal> goals, const SpringOptions& options, const Stop& should_stop,
                     SolveReport& report);
  void sum_levels(std::span<const SpringGoal> goals, std::vector<Level>& levels);
  bool balance_held(std::span<const SpringGoal> goals, int level, const SpringOptions& options, const Stop& should_stop,
                    SolveReport& report);
  bool hold(std::span<const SpringGoal> goals, int level, const SpringOptions& options, const Stop& should_stop,
            SolveReport& report);
  void stiffen(std::span<const SpringGoal> goals, int level, double factor);
  double shift_held(std::span<const SpringGoal> goals, int level);
  bool balance(const SpringOptions& options, const Stop& should_stop, SolveReport& report);
  void go_far(const SpringOptions& options, const Stop& should_stop, SolveReport& report);
  void search(const SpringOptions& options, const Stop& should_stop, SolveReport& report);
  void explore(const SpringOptions& options, const Stop& should_stop, SolveReport& report);
  // `other` brings another answer to state_, and says whether it is to be kept.
  template <class Other>
  void keep_if_better(SolveReport& report, Other other);
  springs::Answer descend(const springs::Tuning& tuning, const Stop& should_stop, SolveReport& report);

  void explain(std::span<const SpringGoal> goals, const SpringOptions& options, SpringPose& out);

  std::vector<std::shared_ptr<const BodyTree>> figures_;
  std::unique_ptr<springs::Kernel> kernel_;
  std::unique_ptr<springs::Explainer> explainer_;
  bool prepared_ = false;
  std::vector<Signature> signatures_;
  springs::Plan plan_;
  std::vector<std::vector<int>> link_of_segment_;  // of each figure
  std::vector<Whole> whole_;                       // of each figure
  std::vector<int> levels_;                        // priorities in use, in their order
  std::vector<springs::Term> terms_;               // of all goals; plan_.terms has them as the level sees them
  std::vector<springs::Term> begun_terms_;         // plan_.terms as a level began
  std::vector<Held> held_;                         // one a term
  std::vector<Level> sums_, other_sums_;           // one a level
  std::vector<double> slope_;                      // one a degree of freedom
  std::vector<springs::State> starts_, lanes_;
  springs::State state_, start_, kept_, origin_, posture_, begun_;
  springs::JointAngles angles_;
  std::vector<std::vector<double>> posture_q_;
  std::size_t own_rests_ = 0;  // of posture goals, while the start pose holds, too
  double cost_ = 0.0;
  double rough_ = 0.0;  // the share of the cost that a descent may leave to those that follow
};

}  // namespace posed
