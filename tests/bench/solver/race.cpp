#include "tests/bench/solver/race.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "server/solver/kinematics.h"

namespace posed::test {
namespace {

constexpr int kRuns = 5, kSlowRuns = 2, kSlowStride = 10;

double microseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
}

void set_times(Row& row, std::vector<double>& times) {
  std::sort(times.begin(), times.end());
  row.median_us = times[times.size() / 2];
  row.p99_us = times[times.size() * 99 / 100];
}

}  // namespace

Row race(const HingeFigure& figure, Contestant& contestant, const ProblemSet& set) {
  // A stream is one piece: its frames cannot be left out.
  const bool thinned = contestant.slow() && !set.stream && set.problems.size() >= 20 * kSlowStride;
  const std::size_t stride = thinned ? kSlowStride : 1;
  Row row(set.name, contestant.who());
  row.runs = contestant.slow() ? kSlowRuns : kRuns;
  row.costs.assign(set.problems.size(), -1.0);
  std::vector<double> times, start = figure.start(), x = start;
  int ok = 0, inside = 0;
  for (std::size_t n = 0; n < set.problems.size(); n += stride) {
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < row.runs; ++run) {
      contestant.prepare(set.problems[n], start, set.stream && n > 0);
      const auto begin = std::chrono::steady_clock::now();
      contestant.solve();
      least = std::min(least, microseconds_since(begin));
    }
    times.push_back(least);
    contestant.answer(x);
    const Verdict verdict = judge(figure, set.problems[n], x);
    ok += set.reachable ? verdict.ok() : verdict.inside;
    inside += verdict.inside;
    row.costs[n] = verdict.cost;
    if (set.stream) start = x;
  }
  row.problems = static_cast<int>(times.size());
  row.ok = static_cast<double>(ok) / row.problems;
  row.inside = static_cast<double>(inside) / row.problems;
  set_times(row, times);
  return row;
}

Row floor_row(const HingeFigure& figure, const Problem& eight) {
  const BodyTree& tree = figure.tree();
  const std::vector<double> q = figure.tree_q(figure.start());
  std::vector<Transform> world(static_cast<std::size_t>(tree.size()));
  std::vector<Vec3> axes(kHinges), points(eight.size());
  Row row("floor", kFloor);
  row.ok = row.inside = row.ratio_floor = 1.0;
  row.problems = row.runs = 1;
  std::vector<double> times;
  constexpr int kSamples = 2000, kBatch = 50;
  for (int sample = 0; sample < kSamples; ++sample) {
    const auto begin = std::chrono::steady_clock::now();
    for (int n = 0; n < kBatch; ++n) {
      forward_kinematics(tree, q, world);
      // As many axes as there are hinges; where a ball's three lie between its turns makes no difference to the work.
      for (std::size_t h = 0; h < axes.size(); ++h) {
        const Hinge& hinge = figure.hinges()[h];
        axes[h] = world[static_cast<std::size_t>(hinge.part)].rotation * hinge.axis;
      }
      for (std::size_t g = 0; g < points.size(); ++g) {
        points[g] = world[static_cast<std::size_t>(eight[g].at.segment)] * eight[g].at.point;
      }
      asm volatile("" : : "g"(axes.data()), "g"(points.data()) : "memory");
    }
    times.push_back(microseconds_since(begin) / kBatch);
  }
  set_times(row, times);
  return row;
}

void compare_costs(std::vector<Row>& rows) {
  if (rows.empty()) return;
  const auto is_peer = [](const Row& row) { return row.who != kOurs && row.inside >= 0.999; };
  // Mean logarithm of the costs over the problems that `row` and all of `others` had.
  const auto mean_log = [&](const Row& row, auto&& also) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t n = 0; n < row.costs.size(); ++n) {
      if (!also(n) || row.costs[n] < 0.0) continue;
      sum += std::log(std::max(row.costs[n], 1e-12));
      ++count;
    }
    return count ? sum / count : std::numeric_limits<double>::infinity();
  };
  const auto all_had = [&](std::size_t n) {
    return std::all_of(rows.begin(), rows.end(), [&](const Row& row) { return row.costs[n] >= 0.0; });
  };
  const Row* best = nullptr;
  for (const Row& row : rows) {
    if (is_peer(row) && (!best || mean_log(row, all_had) < mean_log(*best, all_had))) best = &row;
  }
  if (!best) return;
  for (Row& row : rows) {
    const double own = mean_log(row, [&](std::size_t n) { return best->costs[n] >= 0.0; });
    const double others = mean_log(*best, [&](std::size_t n) { return row.costs[n] >= 0.0; });
    row.cost_ratio = std::exp(own - others);
  }
}

std::vector<Gate> gates(const std::vector<Row>& rows, bool wide_lanes) {
  const auto find = [&](const char* set, const char* who) -> const Row* {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.set == set && row.who == who; });
    return found == rows.end() ? nullptr : &*found;
  };
  const auto rival = [&](const char* set) {
    const Row* best = nullptr;
    for (const Row& row : rows) {
      const bool fit = row.set == set && row.who != kOurs && row.ok >= 0.95 && row.inside >= 0.999;
      if (fit && (!best || row.median_us < best->median_us)) best = &row;
    }
    return best;
  };
  std::vector<Gate> found;
  if (const Row* peer = find("c", "mujoco")) {
    found.push_back({"the peer is an honest one: c, mujoco's median in floors", peer->ratio_floor, 400.0});
  }
  if (!find("c", kOurs)) return found;

  found.push_back({"c: share solved", find("c", kOurs)->ok, 0.995, true});
  struct Speed {
    const char* set;
    double median, p99;  // share of the rival's; 0: no gate
  };
  const double most = std::numeric_limits<double>::infinity();
  for (const Speed& speed :
       {Speed{"a", 1.0 / 3, most}, Speed{"b", 1.0 / 3, most},
        Speed{"c", wide_lanes ? 1.0 / 6 : 1.0 / 4, wide_lanes ? 1.0 / 4 : 1.0 / 3}, Speed{"e", 1.0 / 3, most}}) {
    const Row* const ours = find(speed.set, kOurs);
    const Row* const theirs = rival(speed.set);
    if (!ours) continue;
    if (!theirs) {  // a gate that nobody stands at is not held
      found.push_back(
          {std::string(speed.set) + ": no peer solves 95 % of it, so there is no measure", most, speed.median});
      continue;
    }
    const std::string of = std::string(speed.set) + ": share of " + theirs->who + "'s ";
    found.push_back({of + "median", ours->median_us / theirs->median_us, speed.median});
    if (speed.p99 != most) found.push_back({of + "p99", ours->p99_us / theirs->p99_us, speed.p99});
  }
  if (const Row* ours = find("d", kOurs); ours && ours->cost_ratio) {
    found.push_back({"d: cost against the best peer's", *ours->cost_ratio, 1.001});
  }
  return found;
}

}  // namespace posed::test
