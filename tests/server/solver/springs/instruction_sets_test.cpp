// From a given start the answer is the same on every instruction set: costs to 1e-9, and the joints of nearly all, too.
// Where goals out of reach leave a joint all but free, rounding grows along the way. A cold solve out of reach may end
// in another valley.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <string>

#include "tests/support/spring_bench.h"

namespace posed {
namespace {

using test::SpringBench;

// Solvers made while it lives run on one instruction set.
struct On {
  explicit On(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ~On() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  On(const On&) = delete;
  On& operator=(const On&) = delete;
};

struct Solved {
  std::string on;
  std::vector<std::vector<double>> q;
  std::vector<double> costs;
};

// Goals near by, and out of reach.
Solved solve_all() {
  Solved out;
  std::mt19937 random(131);
  for (int n = 0; n < 100; ++n) {
    SpringBench b(test::human());
    const double reach = n % 2 == 0 ? 0.4 : 1.5;
    for (const char* end : {"right_hand", "left_hand", "right_foot", "head"})
      b.pull(end, b.touch(end) + test::random_point(random, reach));
    const SpringPose pose = b.solve();
    out.on = b.solver.instruction_set();
    out.q.push_back(pose.q[0]);
    out.costs.push_back(pose.report.cost);
  }
  return out;
}

TEST(InstructionSets, GiveTheSameAnswer) {
  std::vector<Solved> all;
  std::string known;
  for (std::int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
    const On on(targets & -targets);
    Solved solved = solve_all();
    if (known.find(" " + solved.on) != std::string::npos) continue;  // two names for one kernel
    known += " " + solved.on;
    all.push_back(std::move(solved));
  }
  RecordProperty("instruction_sets", known);
  if (all.size() < 2) GTEST_SKIP() << "this build has one instruction set only:" << known;
  for (const Solved& other : all) {
    int loose = 0;
    for (std::size_t n = 0; n < all[0].q.size(); ++n) {
      double apart = 0.0;
      for (std::size_t k = 0; k < all[0].q[n].size(); ++k)
        apart = std::max(apart, std::abs(all[0].q[n][k] - other.q[n][k]));
      EXPECT_LT(apart, 1e-7) << all[0].on << " and " << other.on << ", problem " << n;
      loose += apart > 1e-9;
      EXPECT_NEAR(all[0].costs[n], other.costs[n], 1e-9 * std::max(1.0, all[0].costs[n])) << other.on << " " << n;
    }
    EXPECT_LE(loose, 5) << all[0].on << " and " << other.on;
  }
}

}  // namespace
}  // namespace posed
