#include "server/solver/springs/starts.h"

#include <algorithm>
#include <cmath>

#include "server/solver/springs/kernel.h"
#include "server/solver/springs/swing.h"

namespace posed::springs {
namespace {

constexpr double kInner = 0.6;      // share of a range that starts are spread over
constexpr double kFreeRange = 1.0;  // rad or m to either side, where there is no limit
constexpr double kStraight = 0.02;  // rad

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// The additive recurrence of the golden ratio's higher kin (Roberts, "The unreasonable effectiveness of quasirandom
// sequences", 2018), one stream a degree of freedom: even in every single range, and far from itself in pairs.
class Spread {
 public:
  // In [-1, 1]; sample 0 is the middle.
  double operator()(std::size_t sample, std::size_t dimension) const {
    const double step = std::fmod(0.7548776662466927 * static_cast<double>(dimension + 1) +
                                      0.5698402909980532 * static_cast<double>((dimension * dimension) % 1009),
                                  1.0);
    return 2.0 * std::fmod(0.5 + static_cast<double>(sample) * (0.25 + 0.5 * step), 1.0) - 1.0;
  }
};

double start_turn(const Dof& dof, double x) {
  const bool bounded = std::isfinite(dof.min) && std::isfinite(dof.max);
  if (bounded) return 0.5 * (dof.min + dof.max) + 0.5 * kInner * (dof.max - dof.min) * x;
  return std::clamp(kInner * kFreeRange * x, dof.min, dof.max);
}

}  // namespace

void resize(const Plan& plan, State& state) {
  state.turns.assign(plan.dofs.size(), 0.0);
  state.more.assign(plan.more, 0.0);
}

void copy(const State& from, State& to) {
  std::copy(from.turns.begin(), from.turns.end(), to.turns.begin());
  std::copy(from.more.begin(), from.more.end(), to.more.begin());
}

std::vector<State> make_starts(const Plan& plan) {
  const Spread spread;
  std::vector<State> starts(kStarts + 1);
  for (std::size_t n = 0; n < starts.size(); ++n) {
    State& s = starts[n];
    resize(plan, s);
    for (const Link& link : plan.links) {
      double* more = s.more.data() + link.more;
      const auto sample = [&](int k) { return spread(n, at(link.dof + k)); };
      if (link.kind == LinkKind::axes) {
        for (int k = 0; k < link.dofs; ++k)
          s.turns[at(link.dof + k)] = start_turn(plan.dofs[at(link.dof + k)], sample(k));
      } else if (link.kind == LinkKind::ball) {
        const Quat q = glm::normalize(Quat(1.0, 0.3 * sample(0), 0.3 * sample(1), 0.3 * sample(2)));
        more[0] = q.x, more[1] = q.y, more[2] = q.z, more[3] = q.w;
      } else if (link.kind == LinkKind::limb) {
        const Vec3 middle = link.swings_freely                        ? link.limb
                            : link.swing.kind == Swing::Kind::ellipse ? link.swing.center
                                                                      : glm::normalize([&] {
                                                                          Vec3 sum = kZero;
                                                                          for (const Vec3& c : link.swing.corners)
                                                                            sum += c;
                                                                          return sum;
                                                                        }());
        const Vec3 a = perpendicular(middle, kX), b = glm::cross(middle, a);
        const Vec3 d = inside_swing(link, glm::normalize(middle + a * (0.5 * sample(0)) + b * (0.5 * sample(1))));
        more[0] = d.x, more[1] = d.y, more[2] = d.z;
        s.turns[at(link.dof + 2)] = start_turn(plan.dofs[at(link.dof + 2)], sample(2));
      }
    }
  }
  return starts;
}

void place_middle(const Plan& plan, const State& made, State& state) {
  std::copy(made.turns.begin(), made.turns.end(), state.turns.begin());
  for (const Link& link : plan.links) {
    if (link.kind == LinkKind::ball || link.kind == LinkKind::limb)
      std::copy_n(made.more.begin() + link.more, 4, state.more.begin() + link.more);
  }
}

void place_starts(const Plan& plan, const State& from, std::span<const State> made, std::span<State> lanes) {
  constexpr double kHeadings[kStarts] = {0.0, 0.5, -0.5, 1.0, -1.0, 1.5, -1.5, M_PI};  // rad
  for (std::size_t n = 0; n < lanes.size(); ++n) {
    std::copy(from.more.begin(), from.more.end(), lanes[n].more.begin());
    place_middle(plan, made[n + 1], lanes[n]);
    for (const Link& link : plan.links) {
      if (link.kind != LinkKind::floating || link.pinned) continue;
      double* turn = lanes[n].more.data() + link.more + 3;
      const auto q = xyzw(quat_about(kZ, kHeadings[n]) * quat_from_xyzw(std::span<const double>(turn, 4)));
      std::copy(q.begin(), q.end(), turn);
    }
  }
}

void bend_straight_limbs(const Plan& plan, Figures figures, State& state) {
  for (const Link& link : plan.links) {
    if (link.kind != LinkKind::axes || link.parent < 0) continue;
    const Joint& joint = figures[at(link.figure)]->joint(link.segment);
    for (std::size_t k = 0; k < at(link.dofs); ++k) {
      if (k >= joint.axes.size() || glm::dot(joint.axes[k], joint.bend_axis) < 0.99) continue;
      const std::size_t j = at(link.dof) + k;
      if (std::abs(state.turns[j]) < kStraight) state.turns[j] = std::clamp(kStraight, plan.least[j], plan.most[j]);
    }
  }
}

}  // namespace posed::springs
