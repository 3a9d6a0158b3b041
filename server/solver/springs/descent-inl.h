// From a start to the nearest pose in which springs and limits are in balance: damped Newton steps (Levenberg and
// Marquardt), with the exact terms of second order once Gauss-Newton slows down.
#if defined(POSED_SPRINGS_DESCENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_SPRINGS_DESCENT_INL_H_
#undef POSED_SPRINGS_DESCENT_INL_H_
#else
#define POSED_SPRINGS_DESCENT_INL_H_
#endif

#include <algorithm>
#include <limits>

#include "server/solver/springs/kernel.h"
#include "server/solver/springs/pull-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
class Descent {
 public:
  void resize(const Plan& plan, std::size_t ties, std::size_t tie_parts) {
    figure_.resize(plan);
    newton_.resize(plan, ties, tie_parts);
    at_.resize(plan), trial_.resize(plan), step_.resize(plan);
  }

  Steps<T>& start() { return at_; }
  const Steps<T>& reached() const { return at_; }
  const T& cost() const { return cost_; }
  // 1 in the lanes that have come to rest.
  const T& done() const { return done_; }

  void begin(const Tuning& tuning) {
    tuning_ = tuning;
    std::copy(at_.turns.begin(), at_.turns.end(), trial_.turns.begin());
    std::copy(at_.more.begin(), at_.more.end(), trial_.more.begin());
    cost_ = marked_ = T(std::numeric_limits<double>::infinity());
    factor_ = T(tuning.damping);
    second_order_ = T(tuning.second_order ? 1.0 : 0.0);
    done_ = T(0.0);
    gain_ = T(1.0);
    iterations_ = 0;
    careful_ = false;
  }

  // Moves each floating root, as a rigid body, to where its position goals are nearest: a good place to start from.
  void align(const Plan& plan) {
    figure_.place(plan, at_);
    for (std::size_t i = 0; i < plan.links.size(); ++i) {
      if (plan.links[i].kind == LinkKind::floating && !plan.links[i].pinned) align_root(plan, i);
    }
  }

  // One iteration of all lanes. False once none moves any more.
  bool iterate(const Plan& plan) {
    const T zero(0.0), one(1.0);
    figure_.place(plan, trial_);
    const T cost = springs::HWY_NAMESPACE::cost(plan, trial_, figure_, newton_);
    const T before = cost_;
    // Near its rest the cost says no more; the step is good all the same.
    const Mask<T> blind = (magnitude(gain_) <= before * T(kBlind)) & (cost <= before * T(1.0 + kBlindRounding));
    const Mask<T> gained = blind | (cost <= before * T(1.0 + kRounding));
    keep(gained, trial_.turns, at_.turns), keep(gained, trial_.more, at_.more);
    cost_ = select(gained, cost, before);
    const bool first = iterations_++ == 0;
    if (!first) judge(before, cost, gained, blind);
    give_up();
    done_ = select((cost_ <= T(tuning_.enough)) | (factor_ > T(kMostDamping)), one, done_);
    if (!any(done_ < T(0.5))) return false;
    newton_.let_go();
    if (any((!gained) & (done_ < T(0.5)))) {
      careful_ = lanes_of<T>() == 1;
      figure_.place(plan, at_);
    }
    figure_.see_edges(plan);
    pull(plan, at_, figure_, newton_);
    for (int tries = 0;; ++tries) {
      const T damping = factor_ * most(cost_, T(tuning_.least_cost));
      const Mask<T> sound = newton_.factor(plan, at_, figure_, damping, tuning_.by_effort, second_order_, gain_);
      const Mask<T> retry = (!sound) & (second_order_ > zero);
      if (!any(retry)) break;
      // Not convex here: first more damping, then Gauss-Newton, which always is.
      if (tries == kSaddleTries) second_order_ = select(retry, zero, second_order_);
      factor_ = select(retry, most(factor_ * T(4.0), T(1e-3)), factor_);
      pull(plan, at_, figure_, newton_);
    }
    take_step(plan);
    advance(plan);
    return true;
  }

 private:
  static constexpr double kMostDamping = 1e6;
  static constexpr double kRounding = 4e-16;
  // Steps that promise so little of the cost are not judged by it: the rounding of its sum is more.
  static constexpr double kBlind = 1e-12, kBlindRounding = 1e-13;
  static constexpr int kSaddleTries = 2;
  static constexpr int kAgain = 3;
  static constexpr double kAtEdge = 1e-7;  // rad

  static constexpr int kAlignments = 3;

  void align_root(const Plan& plan, std::size_t root) {
    const auto m = static_cast<std::size_t>(plan.links[root].more);
    T* place = &at_.more[m];
    const auto holds = [&](const Term& term) {
      return term.kind == TermKind::point && term.base < 0 && term.weight > 0.0 &&
             plan.links[static_cast<std::size_t>(term.link)].first == static_cast<int>(root);
    };
    double weights = 0.0;
    int points = 0;
    for (const Term& term : plan.terms) {
      if (holds(term)) weights += term.weight, ++points;
    }
    if (points == 0) return;
    const Placed<T> before = figure_.placed(static_cast<int>(root));
    const bool turns = points > 2;  // fewer say too little of how a body is turned
    T damping[6];
    for (int k = 0; k < 6; ++k) damping[k] = T(k < 3 ? 1e-6 * weights : turns ? 1e-3 * weights : 1e12 * weights);
    for (int round = 0; round < (turns ? kAlignments : 1); ++round) {
      const V3<T> centre{place[0], place[1], place[2]};
      const M3<T> rotation = matrix<T>(place[3], place[4], place[5], place[6]);
      Load<T> load;
      load.clear();
      for (const Term& term : plan.terms) {
        if (!holds(term)) continue;
        const Placed<T>& placed = figure_.placed(term.link);
        const V3<T> arm =
            rotation * before.rotation.turned_back(placed.centre + placed.rotation * V3<T>(term.point) - before.centre);
        load.add_point(arm, (centre + arm - V3<T>(term.place)) * T(term.weight), T(term.weight));
      }
      RootFactor<T> factor;
      factor.factor(load, damping, T(0.0));
      T gain(0.0);
      const Wrench<T> motion = factor.solve(load.slope, gain);
      place[0] = place[0] + motion.shift.x, place[1] = place[1] + motion.shift.y, place[2] = place[2] + motion.shift.z;
      turn(place + 3, motion.turn, place + 3);
    }
  }

  // Where a step has failed, joints that their bounds stop are made up for by all others: springs that are far stiffer
  // than the rest forgive nothing.
  void take_step(const Plan& plan) {
    const T most_turn(tuning_.most_turn);
    for (int again = 0; newton_.step(plan, at_, figure_, most_turn, step_) && careful_ && again < kAgain; ++again) {
      pull(plan, at_, figure_, newton_);
      newton_.factor(plan, at_, figure_, factor_ * most(cost_, T(tuning_.least_cost)), tuning_.by_effort, second_order_,
                     gain_);
    }
  }

  // One alone need not be copied: what was `to` is written anew by the next step.
  static HWY_INLINE void keep(const Mask<T>& mask, Memory<T>& from, Memory<T>& to) {
    if constexpr (lanes_of<T>() == 1) {
      if (mask) to.swap(from);
      return;
    }
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = select(mask, from[i], to[i]);
  }

  // What the last step was worth.
  HWY_INLINE void judge(const T& before, const T& cost, const Mask<T>& gained, const Mask<T>& blind) {
    const T zero(0.0), one(1.0);
    // Steps that bounds prescribe may promise less than nothing.
    const T ratio = select(blind, one, select(gain_ > zero, (before - cost) / most(gain_, T(1e-300)), zero));
    const T little = most(before * T(tuning_.relative_gain), T(tuning_.least_gain));
    done_ = select(gained & (magnitude(gain_) <= little), one, done_);
    const T change = select(ratio > T(0.5), T(0.5), select(ratio > T(0.25), one, T(2.0)));
    factor_ = select(gained, most(factor_ * change, T(tuning_.least_damping)), factor_ * T(5.0));
    second_order_ = select(gained & (cost > before * T(tuning_.second_order_from)), one, second_order_);
    if constexpr (lanes_of<T>() == 1) careful_ = careful_ || (second_order_ > 0.0 && ratio < 0.25);
  }

  // A start that comes on too slowly.
  HWY_INLINE void give_up() {
    if (tuning_.patience == 0 || iterations_ % tuning_.patience != 0) return;
    done_ = select(cost_ > marked_ * T(1.0 - tuning_.patience_gain), T(1.0), done_);
    marked_ = cost_;
  }

  // trial_ = at_ moved by the step.
  void advance(const Plan& plan) {
    for (std::size_t j = 0; j < plan.dofs.size(); ++j) trial_.turns[j] = at_.turns[j] + step_.turns[j];
    for (std::size_t i = 0; i < plan.links.size(); ++i) {
      const Link& link = plan.links[i];
      const auto m = static_cast<std::size_t>(link.more), j = static_cast<std::size_t>(link.dof);
      const T* s = &step_.turns[j];
      if (link.kind == LinkKind::floating) {
        for (std::size_t k = m; k < m + 3; ++k) trial_.more[k] = at_.more[k] + step_.more[k];
        turn(&at_.more[m + 3], {step_.more[m + 3], step_.more[m + 4], step_.more[m + 5]}, &trial_.more[m + 3]);
      } else if (link.kind == LinkKind::ball) {
        turn(&at_.more[m], {s[0], s[1], s[2]}, &trial_.more[m]);
        for (std::size_t k = j; k < j + 3; ++k) trial_.turns[k] = T(0.0);
      } else if (link.kind == LinkKind::limb) {
        const Swinging<T>& swinging = figure_.swinging(i);
        // A step along the edge stays on it, as its curvature has promised.
        const Mask<T> along_edge = (s[0] >= T(0.0)) & (swinging.room <= T(kAtEdge));
        const V3<T> d = kept_inside(link, swinging.direction + swinging.out * s[0] + swinging.along * s[1], along_edge);
        trial_.more[m] = d.x, trial_.more[m + 1] = d.y, trial_.more[m + 2] = d.z;
        trial_.turns[j] = trial_.turns[j + 1] = T(0.0);
      }
    }
  }

  // A turn by twice the arc tangent of half of `by`, after `from`.
  static HWY_INLINE void turn(const T* from, const V3<T>& by, T* to) {
    const V3<T> v = by * T(0.5), f{from[0], from[1], from[2]};
    const T w = from[3];
    const V3<T> r = f + v * w + cross(v, f);
    const T s = w - dot(v, f);
    const T inverse = T(1.0) / root(dot(r, r) + s * s);
    to[0] = r.x * inverse, to[1] = r.y * inverse, to[2] = r.z * inverse, to[3] = s * inverse;
  }

  Kinematics<T> figure_;
  Newton<T> newton_;
  Steps<T> at_, trial_, step_;
  Tuning tuning_;
  T cost_, marked_, factor_, second_order_, done_, gain_;
  int iterations_ = 0;
  bool careful_ = false;
};

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
