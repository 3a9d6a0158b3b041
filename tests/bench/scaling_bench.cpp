// bench_scaling [--out FILE] [--seed N] [--quick]: how the spring solver grows with its figure. Random trees of hinges
// and balls under a floating root, with a goal on every 2.5th segment, too far to be reached: what one iteration costs
// for each segment of the reach tree and each goal.
//
// Gate: at 500 segments and 200 goals at most 1.5 times what it is at 50 and 20, in instructions: as the processor
// counts them, else of these two, one step after the other; in time where even that is refused.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <random>

#include "server/solver/springs/spring_solver.h"
#include "tests/bench/bench_output.h"
#include "tests/bench/instructions.h"
#include "tests/support/figures.h"

namespace {

using namespace posed;

constexpr double kGate = 1.5;

std::shared_ptr<const BodyTree> random_tree(std::mt19937& random, int segments) {
  FigureDocument d = test::column(segments, 0.1);
  for (std::size_t i = 1; i < d.segments.size(); ++i) {
    Segment& s = d.segments[i];
    const int back = test::pick(random, 4) == 0 ? test::pick(random, std::min(static_cast<int>(i), 20)) : 0;
    s.parent = d.segments[i - 1 - static_cast<std::size_t>(back)].name;
    s.joint.parent_from_joint.position = test::random_point(random, 0.1);
    if (test::pick(random, 2) == 0) continue;
    s.joint.type = JointType::hinge;
    const Vec3 axes[] = {kX, kY, kZ, glm::normalize(Vec3(1, 1, 1))};
    s.joint.axes = {axes[test::pick(random, 4)]};
    s.joint.limits = {Limit{-1.5, 1.5}};
  }
  return test::build(d);
}

struct Row {
  int segments, goals, links = 0, iterations = 0;
  double us = 1e300, solve_us = 1e300,
         instructions = 1e300;  // of an iteration; of a solve with reports; least of all runs
  double each(double whole) const { return whole / (links + goals); }
};

// Instructions of an iteration: two of each descent against one.
double count_iteration(SpringSolver& solver, const std::vector<SpringGoal>& goals, SpringOptions options,
                       const BodyTree& tree) {
  std::fprintf(stderr, "counting the instructions of an iteration, one step after the other: up to a minute or two\n");
  double counts[2] = {};
  int iterations[2] = {};
  options.explain = false;
  for (int n = 0; n < 2; ++n) {
    SpringPose pose;
    options.iterations = n + 1;
    for (int warm = 0; warm < 2; ++warm) {
      pose.q = {tree.rest()};
      solver.solve(goals, options, {}, pose);
    }
    iterations[n] = pose.report.iterations;
    pose.q = {tree.rest()};
    counts[n] = test::count_by_steps([&] { solver.solve(goals, options, {}, pose); });
  }
  return std::max(0.0, counts[1] - counts[0]) / std::max(1, iterations[1] - iterations[0]);
}

Row measure(std::uint64_t seed, int segments, int count, int runs, bool by_steps) {
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto tree = random_tree(random, segments);
  std::vector<SpringGoal> goals;
  for (int g = 0; g < count; ++g) {
    SpringGoal goal;
    goal.at = {(segments - 1) * (g + 1) / count, {0, 0, 0.1}};
    goal.spring = PositionSpring{test::random_point(random, 5.0)};
    goals.push_back(goal);
  }
  SpringSolver solver(tree);
  SpringOptions options;
  options.iterations = 10;
  test::Instructions counter;
  SpringPose pose;
  Row row{segments, count};
  for (int n = 0; n < runs; ++n) {
    options.explain = n % 10 == 9;
    pose.q = {tree->rest()};
    const double before = counter.now();
    const auto begin = std::chrono::steady_clock::now();
    solver.solve(goals, options, {}, pose);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
    const double instructions = counter.now() - before;
    row.iterations = pose.report.iterations;
    if (options.explain) {
      row.solve_us = std::min(row.solve_us, took.count());
      continue;
    }
    row.us = std::min(row.us, took.count() / row.iterations);
    if (counter.counts()) row.instructions = std::min(row.instructions, instructions / row.iterations);
  }
  if (!counter.counts()) row.instructions = by_steps ? count_iteration(solver, goals, options, *tree) : 0.0;
  row.links = static_cast<int>(solver.plan().links.size());
  return row;
}

}  // namespace

int main(int argc, char** argv) try {
  test::BenchOutput out(argc, argv);
  std::printf("%8s %6s %6s %6s %13s %9s %14s %10s %20s\n", "segments", "goals", "links", "iter.", "us/iteration",
              "ns/each", "instr./iter.", "instr./each", "us/solve with states");
  std::vector<Row> rows;
  for (const auto& [segments, goals] : {std::pair{50, 20}, {100, 40}, {200, 80}, {500, 200}}) {
    const bool at_an_end = segments == 50 || segments == 500;
    const Row& r =
        rows.emplace_back(measure(out.seed(), segments, goals, out.quick() ? 20 : 400, at_an_end && !out.quick()));
    std::printf("%8d %6d %6d %6d %13.2f %9.2f %14.0f %10.1f %20.1f\n", segments, goals, r.links, r.iterations, r.us,
                1e3 * r.each(r.us), r.instructions, r.each(r.instructions), r.solve_us);
    out.row(
        R"({"bench":"scaling","case":"%d segments, %d goals","who":"posed/springs","iteration_us":%.3f,"each_ns":%.3f,"each_instructions":%.1f,"solve_us":%.1f})",
        segments, goals, r.us, 1e3 * r.each(r.us), r.each(r.instructions), r.solve_us);
  }
  const bool counted = rows.front().instructions > 0.0 && rows.back().instructions > 0.0;
  const auto each = [&](const Row& r) { return counted ? r.each(r.instructions) : r.each(r.us); };
  const double ratio = each(rows.back()) / each(rows.front());
  std::printf("%s for each segment and goal, 500/200 against 50/20: %.3f, to be at most %.1f\n",
              counted ? "instructions" : "time (this machine lets nobody count instructions)", ratio, kGate);
  out.row(R"({"bench":"scaling","case":"500/200 against 50/20","who":"posed/springs","ratio":%.3f})", ratio);
  return ratio <= kGate || out.quick() ? 0 : 1;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_scaling: %s\n", e.what());
  return 1;
}
