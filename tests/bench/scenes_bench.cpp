// bench_scenes [--out FILE] [--quick]: the paper's scenes, each solved from its start, over and over. The paper's own
// time for "all the examples shown" was 5 to 30 s (Iris 3030, 1987).
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "tests/bench/bench_output.h"
#include "tests/support/scene_file.h"

namespace {

using posed::Pose;

const char* const kScenes[] = {"paper/single-reach", "paper/two-reaches", "paper/unreachable", "paper/sitting",
                               "paper/restrained",   "paper/seat-belt",   "paper/two-hands",   "paper/straighten"};

struct Row {
  std::string scene;
  double median_us = 0.0, p99_us = 0.0;
  posed::SolveReport report;
};

Row measure(const std::string& scene, int runs) {
  auto file = posed::test::read_template(POSED_SOURCE_DIR, scene);
  posed::ReachTreeSolver solver(file.tree);
  Pose pose;
  std::vector<double> q, times;
  times.reserve(static_cast<std::size_t>(runs));
  for (int n = -runs / 10 - 1; n < runs; ++n) {  // the first tenth warms up
    q = file.start;
    const auto begin = std::chrono::steady_clock::now();
    solver.solve(q, file.goals, {}, {}, pose);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
    if (n >= 0) times.push_back(took.count());
  }
  std::sort(times.begin(), times.end());
  return {scene, times[times.size() / 2], times[times.size() * 99 / 100], pose.report};
}

}  // namespace

int main(int argc, char** argv) try {
  posed::test::BenchOutput out(argc, argv);
  std::printf("%-20s %10s %10s %13s %11s %14s %8s\n", "scene", "median_us", "p99_us", "chain_solves", "iterations",
              "balance_error", "paper_s");
  for (const char* scene : kScenes) {
    const Row r = measure(scene, out.quick() ? 200 : 5000);
    std::printf("%-20s %10.1f %10.1f %13d %11d %14.1e %8s\n", scene, r.median_us, r.p99_us, r.report.chain_solves,
                r.report.iterations, r.report.balance_error, "5..30");
    out.row(
        R"({"bench":"scenes","case":"%s","who":"posed/reach_tree","median_us":%.2f,"p99_us":%.2f,"chain_solves":%d,"iterations":%d,"balance_error":%.3g,"paper_s":"5..30"})",
        scene, r.median_us, r.p99_us, r.report.chain_solves, r.report.iterations, r.report.balance_error);
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_scenes: %s\n", e.what());
  return 1;
}
