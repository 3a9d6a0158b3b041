// bench_scenes [--out FILE] [--quick]: the paper's scenes, each solved from its start, over and over, by the paper's
// method and by springs (limits off, as the paper knows none). The paper's own time for "all the examples shown" was
// 5 to 30 s (Iris 3030, 1987).
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "server/solver/springs/spring_solver.h"
#include "tests/bench/bench_output.h"
#include "tests/support/scene_file.h"
#include "tests/support/unlimited.h"

namespace {

using posed::Pose;

const char* const kScenes[] = {"paper/single-reach", "paper/two-reaches", "paper/unreachable", "paper/sitting",
                               "paper/restrained",   "paper/seat-belt",   "paper/two-hands",   "paper/straighten"};

struct Row {
  double median_us = 0.0, p99_us = 0.0;
  posed::SolveReport report;
};

// `solve` starts from the scene's start every time and returns its report.
template <class Solve>
Row measure(int runs, const Solve& solve) {
  Row row;
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(runs));
  for (int n = -runs / 10 - 1; n < runs; ++n) {  // the first tenth warms up
    const auto begin = std::chrono::steady_clock::now();
    row.report = solve();
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
    if (n >= 0) times.push_back(took.count());
  }
  std::sort(times.begin(), times.end());
  row.median_us = times[times.size() / 2];
  row.p99_us = times[times.size() * 99 / 100];
  return row;
}

Row reach_tree(const posed::test::SceneFile& file, int runs) {
  posed::ReachTreeSolver solver(file.tree);
  Pose pose;
  std::vector<double> q;
  return measure(runs, [&] {
    q = file.start;
    solver.solve(q, file.goals, {}, {}, pose);
    return pose.report;
  });
}

Row springs(const posed::test::SceneFile& file, int runs) {
  posed::SpringSolver solver(file.tree);
  const auto goals = posed::test::as_springs(file.goals);
  posed::SpringPose pose;
  pose.q = {file.start};
  return measure(runs, [&] {
    pose.q[0] = file.start;
    solver.solve(goals, {}, {}, pose);
    return pose.report;
  });
}

void write(posed::test::BenchOutput& out, const char* scene, const char* method, const Row& r) {
  out.row(
      R"({"bench":"scenes","case":"%s","who":"posed/%s","median_us":%.2f,"p99_us":%.2f,"cost":%.9g,"chain_solves":%d,"iterations":%d,"balance_error":%.3g,"paper_s":"5..30"})",
      scene, method, r.median_us, r.p99_us, r.report.cost, r.report.chain_solves, r.report.iterations,
      r.report.balance_error);
}

}  // namespace

int main(int argc, char** argv) try {
  posed::test::BenchOutput out(argc, argv);
  std::printf("%-20s %10s %10s %12s | %10s %10s %12s | %8s %8s\n", "scene", "reach: us", "p99_us", "cost",
              "springs: us", "p99_us", "cost", "cost x", "time x");
  for (const char* scene : kScenes) {
    const auto file = posed::test::without_limits(posed::test::read_template(POSED_SOURCE_DIR, scene));
    const int runs = out.quick() ? 200 : 5000;
    const Row paper = reach_tree(file, runs), ours = springs(file, runs);
    std::printf("%-20s %10.1f %10.1f %12.4g | %10.1f %10.1f %12.4g | %8.3f %8.3f\n", scene, paper.median_us,
                paper.p99_us, paper.report.cost, ours.median_us, ours.p99_us, ours.report.cost,
                ours.report.cost / std::max(paper.report.cost, 1e-12), ours.median_us / paper.median_us);
    write(out, scene, "reach_tree", paper);
    write(out, scene, "springs", ours);
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_scenes: %s\n", e.what());
  return 1;
}
