// bench_solver [--out FILE] [--seed N] [--quick]: problem sets a to e (problems.h) on the built-in figure, solved by
// posed and by others, judged by one forward kinematics that is nobody's own. One thread, pinned to one CPU.
//
// The exit status is not 0 where a gate (race.h) is missed or fewer than three peers are here; with --quick, which
// measures nothing worth having, both are only said.
#include <sched.h>

#include <algorithm>
#include <cstdio>
#include <exception>

#include "tests/bench/bench_output.h"
#include "tests/bench/solver/race.h"
#include "tests/support/figures.h"

namespace {

using namespace posed::test;

constexpr int kProblems = 2000, kQuickProblems = 20, kFrames = 1000, kLeastPeers = 3;

// The peers know no swing and twist.
HingeFigure hinged_human() {
  auto tree = posed::BodyTree::build(boxed_human());
  return HingeFigure(std::move(*tree));
}

void stay_on_this_cpu() {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(sched_getcpu()), &one);
  if (sched_setaffinity(0, sizeof one, &one) != 0) std::printf("could not pin the thread: figures may wander\n");
}

bool has_wide_lanes() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512f");
#else
  return false;
#endif
}

std::vector<std::unique_ptr<Contestant>> contestants(const HingeFigure& figure) {
  std::vector<std::unique_ptr<Contestant>> all;
  all.push_back(springs_contestant(figure));
#ifdef BENCH_HAS_MUJOCO
  all.push_back(mujoco_peer(figure));
#endif
#ifdef BENCH_HAS_CERES
  all.push_back(ceres_peer(figure));
#endif
#ifdef BENCH_HAS_KDL
  all.push_back(kdl_peer(figure));
#endif
#ifdef BENCH_HAS_SIMBODY
  all.push_back(simbody_peer(figure));
#endif
  return all;
}

void print(const Row& row) {
  std::printf("%-5s %-14s %8d x %d %7.1f %11.2f %11.2f %9.1f", row.set.c_str(), row.who.c_str(), row.problems, row.runs,
              100.0 * row.ok, row.median_us, row.p99_us, row.ratio_floor);
  if (row.cost_ratio) std::printf(" %10.4f", *row.cost_ratio);
  std::printf("\n");
  std::fflush(stdout);
}

void write(BenchOutput& out, const Row& row) {
  char cost[64] = "";
  if (row.cost_ratio) std::snprintf(cost, sizeof cost, R"(,"cost_ratio":%.5f)", *row.cost_ratio);
  out.row(R"({"bench":"solver","case":"%s","who":"%s","median_us":%.3f,"p99_us":%.3f,"ok":%.4f,"ratio_floor":%.2f%s})",
          row.set.c_str(), row.who.c_str(), row.median_us, row.p99_us, row.ok, row.ratio_floor, cost);
}

// True when all are held.
bool print_gates(const std::vector<Row>& rows) {
  bool all = true;
  for (const Gate& gate : gates(rows, has_wide_lanes())) {
    std::printf("%-6s %-58s %10.4f, to be %s %.4f\n", gate.held() ? "held" : "MISSED", gate.what.c_str(), gate.value,
                gate.at_least ? "at least" : "at most", gate.bound);
    all = all && gate.held();
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) try {
  BenchOutput out(argc, argv);
  stay_on_this_cpu();
  const HingeFigure figure = hinged_human();
  const int count = out.quick() ? kQuickProblems : kProblems;
  const auto sets = problem_sets(figure, out.seed(), count, out.quick() ? 10 * kQuickProblems : kFrames);
  const auto all = contestants(figure);

  std::printf("%-5s %-14s %12s %7s %11s %11s %9s %10s\n", "case", "who", "problems", "ok_%", "median_us", "p99_us",
              "floors", "cost_ratio");
  std::vector<Row> rows = {floor_row(figure, sets[2].problems.front())};
  const double floor_us = rows.front().median_us;
  print(rows.front());
  write(out, rows.front());
  for (const ProblemSet& set : sets) {
    std::vector<Row> of_set;
    for (const auto& contestant : all) of_set.push_back(race(figure, *contestant, set));
    if (!set.reachable) compare_costs(of_set);
    for (Row& row : of_set) {
      row.ratio_floor = row.median_us / floor_us;
      print(row);
      write(out, row);
      rows.push_back(std::move(row));
    }
  }
  std::printf(
      "problems: how many, x of how many runs each time is the least. ok: weighted RMS residual within 1 mm and\n"
      "all hinges in their ranges; case d cannot be reached: the ranges only. mujoco: up to %d starts, like\n"
      "posed; the others are asked once, as their users would.\n",
      kStarts);

  bool fine = print_gates(rows);
  const auto peers = static_cast<int>(
      std::count_if(all.begin(), all.end(), [](const auto& contestant) { return contestant->who() != kOurs; }));
  if (*BENCH_MISSING) std::printf("not here, so not in the race (Debian's packages): %s\n", BENCH_MISSING);
  if (peers < kLeastPeers) {
    std::printf("MISSED %d peers, to be at least %d\n", peers, kLeastPeers);
    fine = false;
  }
  return fine || out.quick() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_solver: %s\n", error.what());
  return 1;
}
