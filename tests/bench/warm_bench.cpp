// bench_warm [--out FILE] [--quick]: a warm frame (set e of bench_solver: one hand follows a curve, feet and pelvis are
// held with weight 100) against what no solver can do without: the built-in figure's forward kinematics with all joint
// axes and 8 points, scalar. Gate: at most 5 times; with --quick it is only said.
//
// In instructions, of all frames where the processor counts them, else of some, one step after the other.
#include <chrono>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>

#include "server/solver/kinematics.h"
#include "server/solver/springs/spring_solver.h"
#include "server/solver/tempus.h"
#include "tests/bench/bench_output.h"
#include "tests/bench/instructions.h"
#include "tests/support/spring_figures.h"

namespace {

using namespace posed;

constexpr double kGate = 5.0;
constexpr int kStepped = 10;  // frames

struct Measured {
  double us = 0.0, instructions = 0.0;  // of a frame
};

Measured measure(const std::function<void(int)>& frame, int count) {
  frame(0);  // warms up
  test::Instructions counter;
  const double before = counter.now();
  const auto begin = std::chrono::steady_clock::now();
  for (int n = 1; n <= count; ++n) frame(n);
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
  if (counter.counts()) return {took.count() / count, (counter.now() - before) / count};
  const double stepped = test::count_by_steps([&] {
    for (int n = count + 1; n <= count + kStepped; ++n) frame(n);
  });
  return {took.count() / count, stepped / kStepped};
}

// All joint axes in the world and eight points, for the pose `q`; returns something that depends on all of it.
double plain_kinematics(const BodyTree& tree, const std::vector<double>& q, std::vector<Transform>& world,
                        std::vector<Vec3>& axes, const std::vector<AttachedPoint>& points) {
  forward_kinematics(tree, q, world);
  std::size_t next = 0;
  for (int i = 0; i < tree.size(); ++i) {
    const Joint& joint = tree.joint(i);
    if (joint.type == JointType::free) continue;
    const Quat before = world[static_cast<std::size_t>(tree.parent(i))].rotation * joint.parent_from_joint.rotation;
    const Quat after = world[static_cast<std::size_t>(i)].rotation;
    if (joint.type == JointType::universal) {
      axes[next++] = before * joint.axes[0];
      axes[next++] = after * joint.axes[1];
    } else {
      axes[next++] = before * kX, axes[next] = glm::cross(axes[next - 1], after * kZ), axes[next + 1] = after * kZ;
      next += 2;
    }
  }
  double sum = 0.0;
  for (const AttachedPoint& p : points) sum += (world[static_cast<std::size_t>(p.segment)] * p.point).z;
  for (std::size_t k = 0; k < next; ++k) sum += axes[k].x;
  return sum;
}

// Set e.
std::function<void(int)> warm_frames(const std::shared_ptr<const BodyTree>& tree) {
  auto solver = std::make_shared<SpringSolver>(tree);
  auto pose = std::make_shared<SpringPose>();
  pose->q = {start_pose(*tree)};
  std::vector<Transform> world(static_cast<std::size_t>(tree->size()));
  forward_kinematics(*tree, pose->q[0], world);
  const auto place = [&](const char* segment) {
    const AttachedPoint at = tree->attach({segment, {}, ""}).value();
    return world[static_cast<std::size_t>(at.segment)] * at.point;
  };
  std::vector<SpringGoal> goals;
  for (const char* segment : {"right_hand", "left_foot", "right_foot", "lower_torso"})
    goals.push_back(test::goal_at(*tree, segment, PositionSpring{place(segment)}, goals.empty() ? 10.0 : 100.0));
  const Vec3 hand = place("right_hand");
  SpringOptions options;
  options.accuracy = 5e-5;
  options.explain = false;
  return [=](int n) mutable {
    const double t = n / 240.0;
    const Vec3 target = hand + Vec3(0.20 * (1.0 - std::cos(3.0 * t)), 0.10 * (std::cos(2.0 * t) - 1.0),
                                    0.25 * (1.0 - std::cos(2.5 * t)));
    std::get<PositionSpring>(goals[0].spring).position = target;
    solver->solve(goals, options, {}, *pose);
  };
}

}  // namespace

int main(int argc, char** argv) try {
  test::BenchOutput out(argc, argv);
  const auto tree = test::human();
  const auto q = start_pose(*tree);
  std::vector<Transform> world(static_cast<std::size_t>(tree->size()));
  std::vector<Vec3> axes(static_cast<std::size_t>(tree->dof()));
  std::vector<AttachedPoint> points;
  for (const char* segment : {"right_hand", "left_hand", "right_foot", "left_foot", "head", "lower_torso",
                              "right_upper_arm", "left_upper_arm"}) {
    points.push_back(tree->attach({segment, {}, ""}).value());
  }
  double sum = 0.0;
  const auto floor = [&](int) { sum += plain_kinematics(*tree, q, world, axes, points); };

  const int frames = out.quick() ? 200 : 10'000;
  std::printf("%-6s %8s %10s %14s %12s\n", "case", "frames", "us", "instructions", "ratio_floor");
  Measured base;
  double ratio = 1.0;
  for (const std::string name : {"floor", "warm"}) {
    const Measured m = measure(name == "floor" ? std::function<void(int)>(floor) : warm_frames(tree), frames);
    if (name == "floor") base = m;
    ratio = m.instructions > 0.0 ? m.instructions / base.instructions : m.us / base.us;
    std::printf("%-6s %8d %10.3f %14.0f %12.2f\n", name.c_str(), frames, m.us, m.instructions, ratio);
    out.row(R"({"bench":"warm","case":"%s","who":"%s","mean_us":%.4f,"instructions":%.0f,"ratio_floor":%.3f})",
            name.c_str(), name == "floor" ? "floor" : "posed/springs", m.us, m.instructions, ratio);
  }
  const bool counted = base.instructions > 0.0;
  std::printf("warm against floor, in %s: %.2f, to be at most %.1f\n",
              counted ? "instructions" : "time (instructions cannot be counted here)", ratio, kGate);
  if (counted && ratio > kGate && !out.quick()) return 1;
  return sum == 1e300 ? 1 : 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_warm: %s\n", e.what());
  return 1;
}
