// The door to the code that is compiled for each instruction set: one Kernel, chosen when it is made.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "server/solver/springs/plan.h"

namespace posed::springs {

inline constexpr int kStarts = 8;

// Costs are sums of weight x error squared; damping is a share of the present cost.
struct Tuning {
  double damping = 0.1;
  double least_damping = 1e-12;
  double least_cost = 0.0;    // that damping is a share of
  bool align = false;         // begin with floating roots moved, as rigid bodies, to where goals are nearest
  bool by_effort = false;     // limbs before the trunk, the trunk before the root: Dof::effort
  bool second_order = false;  // at once; else where a step leaves more than this of the cost:
  double second_order_from = 0.9;
  double most_turn = 1.0;        // rad or m; of a degree of freedom in one step
  double relative_gain = 1e-12;  // a step that promises less of the cost is the last,
  double least_gain = 0.0;       // or less than this
  double enough = 0.0;           // a cost that needs no further step
  double most_start = 1e300;     // a start that costs more is left as it is (Answer::too_far)
  int patience = 0;              // in so many iterations
  double patience_gain = 0.3;    // so much has to be gained; 0 iterations: no matter
  int iterations = 200;
};

struct Answer {
  double cost = 0.0;
  int iterations = 0;
  bool at_rest = false;  // else it ran out of iterations, or was stopped
  bool stopped = false;
  bool too_far = false;
};

class Kernel {
 public:
  virtual ~Kernel() = default;
  // Memory for solves on this plan: after it nothing allocates.
  virtual void prepare(const Plan& plan) = 0;
  // From `state` to the nearest balance. `should_stop` may be empty; it is asked before every iteration but the first.
  virtual Answer descend(const Plan& plan, const Tuning& tuning, const std::function<bool()>& should_stop,
                         State& state) = 0;
  // From kStarts states side by side, until one has enough or none comes on; `states[0]` gets the best.
  virtual Answer search(const Plan& plan, const Tuning& tuning, const std::function<bool()>& should_stop,
                        std::span<State> states) = 0;
  virtual const char* instruction_set() const = 0;
};

// For the instruction set of this machine.
std::unique_ptr<Kernel> make_kernel();

}  // namespace posed::springs
