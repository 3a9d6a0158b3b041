// What the contestants are asked, and the judge. All goals are position goals on touch points, metres and world axes.
//
//   a  1 goal: a hand                                 b  4: hands, feet
//   c  8: hands, feet, head, pelvis, both elbows      d  c's goals, pushed 1.5 times as far from their centroid
//   e  1000 frames at 240 Hz: one hand (weight 10) follows a smooth curve, feet and pelvis are held with weight 100;
//      each frame starts from the contestant's last answer
//
// Targets of a to d are where the points are in random poses: hinges anywhere in their ranges (unlimited: any angle),
// the root within half a metre of the start along each axis, its heading within 90 degrees of the start's and then
// leaning by up to 30 degrees about X and about Y. Every problem of a to d starts from the figure's start pose.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/solver/hinge_figure.h"

namespace posed::test {

struct PointGoal {
  AttachedPoint at;
  Vec3 target{0.0, 0.0, 0.0};
  double weight = 10.0;
};

using Problem = std::vector<PointGoal>;

// The same but for their targets, as the problems of one set are: a solver that is built for its points serves both.
bool same_points(const Problem& a, const Problem& b);

struct ProblemSet {
  std::string name;
  bool stream = false;    // each problem starts from the answer before
  bool reachable = true;  // in full; else it is the cost that counts
  std::vector<Problem> problems;
};

// Weighted RMS residual, m: what a contestant should try for, so that all stop alike, and what the judge takes.
inline constexpr double kAskedRms = 1e-4;
inline constexpr double kJudgedRms = 1e-3;
inline constexpr double kJudgedAngle = 1e-6;  // rad beyond a limit

// Deterministic: the same `seed` and `count` make the same problems on every machine.
std::vector<ProblemSet> problem_sets(const HingeFigure& figure, std::uint64_t seed, int count, int frames);

struct Verdict {
  double cost = 0.0;  // sum of weight x squared distance
  double rms = 0.0;   // root of cost / sum of weights, m
  bool inside = false;
  bool ok() const { return inside && rms <= kJudgedRms; }
};

Verdict judge(const HingeFigure& figure, const Problem& problem, std::span<const double> x);

}  // namespace posed::test
