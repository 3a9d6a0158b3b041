// bench_scenes [FILE] [--quick]: the paper's scenes, each solved from its start, over and over. Prints a table; FILE
// gets an array of flat rows. The paper's own time for "all the examples shown" was 5 to 30 s (Iris 3030, 1987).
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

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

bool write(const char* path, const std::vector<Row>& rows) {
  std::FILE* file = std::fopen(path, "w");
  if (!file) return false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& r = rows[i];
    std::fprintf(
        file,
        "%s{\"bench\":\"scenes\",\"case\":\"%s\",\"who\":\"posed/reach_tree\",\"median_us\":%.2f,\"p99_us\":%.2f,"
        "\"chain_solves\":%d,\"iterations\":%d,\"balance_error\":%.3g,\"paper_s\":\"5..30\"}%s\n",
        i == 0 ? "[" : " ", r.scene.c_str(), r.median_us, r.p99_us, r.report.chain_solves, r.report.iterations,
        r.report.balance_error, i + 1 == rows.size() ? "]" : ",");
  }
  return std::fclose(file) == 0;
}

}  // namespace

int main(int argc, char** argv) try {
  const char* path = nullptr;
  int runs = 5000;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) {
      runs = 200;
    } else {
      path = argv[i];
    }
  }
  std::vector<Row> rows;
  std::printf("%-20s %10s %10s %13s %11s %14s %8s\n", "scene", "median_us", "p99_us", "chain_solves", "iterations",
              "balance_error", "paper_s");
  for (const char* scene : kScenes) {
    rows.push_back(measure(scene, runs));
    const Row& r = rows.back();
    std::printf("%-20s %10.1f %10.1f %13d %11d %14.1e %8s\n", scene, r.median_us, r.p99_us, r.report.chain_solves,
                r.report.iterations, r.report.balance_error, "5..30");
  }
  if (path && !write(path, rows)) {
    std::fprintf(stderr, "bench_scenes: can not write %s\n", path);
    return 1;
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_scenes: %s\n", e.what());
  return 1;
}
