#include "tests/bench/solver/problems.h"

#include <algorithm>
#include <stdexcept>

#include "common/goal.h"
#include "tests/bench/solver/random.h"

namespace posed::test {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kFrameRate = 240.0;

AttachedPoint touch_point(const BodyTree& tree, const char* segment) {
  auto at = tree.attach(Attachment{segment, {}, {}});
  if (!at) throw std::runtime_error(std::string("the figure has no ") + segment);
  return *at;
}

Vec3 reached(const Placement& placement, const AttachedPoint& at) {
  return placement.world_from_part[static_cast<std::size_t>(at.segment)] * at.point;
}

std::vector<double> random_pose(const HingeFigure& figure, Random& random) {
  std::vector<double> x = figure.start();
  for (std::size_t k = 0; k < 3; ++k) x[k] += random.uniform(-0.5, 0.5);
  const double heading = random.uniform(-90.0, 90.0) * kDegree;
  const double lean_x = random.uniform(-30.0, 30.0) * kDegree, lean_y = random.uniform(-30.0, 30.0) * kDegree;
  const auto turn =
      xyzw(quat_about(kZ, heading) * quat_about(kX, lean_x) * quat_about(kY, lean_y) * root_turn(figure.start()));
  std::copy(turn.begin(), turn.end(), x.begin() + 3);
  for (std::size_t h = 0; h < figure.hinges().size(); ++h) {
    const Hinge& hinge = figure.hinges()[h];
    x[kRootSize + h] = hinge.limited() ? random.uniform(hinge.min, hinge.max) : random.uniform(-M_PI, M_PI);
  }
  return x;
}

void push_out(Problem& problem) {
  Vec3 centroid = kZero;
  for (const PointGoal& goal : problem) centroid += goal.target / static_cast<double>(problem.size());
  for (PointGoal& goal : problem) goal.target = centroid + 1.5 * (goal.target - centroid);
  problem.front().weight = 100.0;
}

ProblemSet random_set(const HingeFigure& figure, const char* name, std::span<const AttachedPoint> points, int count,
                      std::uint64_t seed) {
  Random random(seed);
  Placement placement;
  ProblemSet set;
  set.name = name;
  for (int n = 0; n < count; ++n) {
    figure.place(random_pose(figure, random), placement);
    Problem problem;
    for (const AttachedPoint& at : points) problem.push_back({at, reached(placement, at), 10.0});
    set.problems.push_back(std::move(problem));
  }
  return set;
}

// The hand leaves its place with speed 0, moves forward and up by up to half a metre, and comes back, at up to 1 m/s.
ProblemSet stream_set(const HingeFigure& figure, int frames) {
  const BodyTree& tree = figure.tree();
  Placement placement;
  figure.place(figure.start(), placement);
  const AttachedPoint hand = touch_point(tree, "right_hand");
  ProblemSet set;
  set.name = "e", set.stream = true;
  for (int n = 1; n <= frames; ++n) {
    const double t = n / kFrameRate;
    const Vec3 way(0.20 * (1.0 - std::cos(3.0 * t)), 0.10 * (std::cos(2.0 * t) - 1.0),
                   0.25 * (1.0 - std::cos(2.5 * t)));
    Problem problem = {{hand, reached(placement, hand) + way, 10.0}};
    for (const char* held : {"left_foot", "right_foot", "lower_torso"}) {
      const AttachedPoint at = touch_point(tree, held);
      problem.push_back({at, reached(placement, at), 100.0});
    }
    set.problems.push_back(std::move(problem));
  }
  return set;
}

}  // namespace

bool same_points(const Problem& a, const Problem& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const PointGoal& x, const PointGoal& y) {
    return x.at.segment == y.at.segment && x.at.point == y.at.point && x.weight == y.weight;
  });
}

std::vector<ProblemSet> problem_sets(const HingeFigure& figure, std::uint64_t seed, int count, int frames) {
  std::vector<AttachedPoint> points;
  for (const char* segment : {"right_hand", "left_hand", "right_foot", "left_foot", "head", "lower_torso",
                              "right_upper_arm", "left_upper_arm"}) {
    points.push_back(touch_point(figure.tree(), segment));
  }
  const std::span all(points);
  std::vector<ProblemSet> sets = {random_set(figure, "a", all.first(1), count, seed * 4),
                                  random_set(figure, "b", all.first(4), count, seed * 4 + 1),
                                  random_set(figure, "c", all, count, seed * 4 + 2),
                                  random_set(figure, "d", all, count, seed * 4 + 3), stream_set(figure, frames)};
  sets[3].reachable = false;
  for (Problem& problem : sets[3].problems) push_out(problem);
  return sets;
}

Verdict judge(const HingeFigure& figure, const Problem& problem, std::span<const double> x) {
  Verdict verdict;
  const double turn = glm::length(root_turn(x));
  bool sound = std::abs(turn - 1.0) < 1e-9;
  for (const double value : x) sound = sound && std::isfinite(value);
  Placement placement;
  figure.place(x, placement);
  double weights = 0.0;
  for (const PointGoal& goal : problem) {
    const Vec3 miss = goal.target - reached(placement, goal.at);
    verdict.cost += goal.weight * glm::dot(miss, miss);
    weights += goal.weight;
  }
  verdict.rms = std::sqrt(verdict.cost / weights);
  verdict.inside = sound && figure.beyond_limits(x) <= kJudgedAngle;
  return verdict;
}

}  // namespace posed::test
