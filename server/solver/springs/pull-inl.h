// All goals pull at a placed figure: the cost, and what they add to the segments' loads.
#if defined(POSED_SPRINGS_PULL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_SPRINGS_PULL_INL_H_
#undef POSED_SPRINGS_PULL_INL_H_
#else
#define POSED_SPRINGS_PULL_INL_H_
#endif

#include "server/solver/goals/aim-inl.h"
#include "server/solver/goals/balance-inl.h"
#include "server/solver/goals/distance-inl.h"
#include "server/solver/goals/line-inl.h"
#include "server/solver/goals/orientation-inl.h"
#include "server/solver/goals/plane-inl.h"
#include "server/solver/goals/position-inl.h"
#include "server/solver/goals/posture-inl.h"
#include "server/solver/springs/newton-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
HWY_INLINE void measure(const Term& term, const Placed<T>& segment, const Base<T>& base, Errors<T>& out) {
  switch (term.kind) {
    case TermKind::point:
      return measure_position(term, segment, base, out);
    case TermKind::turn:
      return measure_orientation(term, segment, base, out);
    case TermKind::aim:
      return measure_aim(term, segment, base, out);
    case TermKind::plane:
      return measure_plane(term, segment, base, out);
    case TermKind::line:
      return measure_line(term, segment, base, out);
    case TermKind::distance:
      return measure_distance(term, segment, base, out);
    case TermKind::balance:
      return;
  }
}

// Of a turn against the world. `torque`: the slope of its cost.
template <class T>
HWY_INLINE void add_second_order_turn(const Errors<T>& errors, const V3<T>& torque, const T& weight, Load<T>& load) {
  if (errors.tips) {
    load.add_second_order_tip(errors.tip, errors.tip_way * (errors.error[0] * weight));
    return;
  }
  const T square = dot(torque, torque);
  load.add_second_order_torque(torque, errors.excess * weight / most(square, T(1e-300)));
}

template <class T>
HWY_INLINE V3<T> miss_of(const Term& term, const Placed<T>& segment, const V3<T>& arm) {
  return segment.centre + arm - V3<T>(term.place + Vec3(term.shift[0], term.shift[1], term.shift[2]));
}

template <class T>
HWY_INLINE void pull_term(const Plan& plan, const Term& term, const Kinematics<T>& figure, Newton<T>& newton) {
  const T weight(term.weight), zero(0.0);
  if (term.kind == TermKind::balance) return pull_balance(plan, term, figure, newton);
  const Placed<T>& segment = figure.placed(term.link);
  Load<T>& load = newton.load(term.link);
  if (term.kind == TermKind::point && term.base < 0) {
    const V3<T> arm = segment.rotation * V3<T>(term.point);
    load.add_point(arm, miss_of(term, segment, arm) * weight, weight);
    return;
  }
  Base<T> base;
  if (term.base >= 0) base.placed = &figure.placed(term.base);
  Errors<T> errors;
  measure(term, segment, base, errors);
  V3<T> pull{zero, zero, zero}, turn = pull;
  for (int i = 0; i < errors.count; ++i) {
    const bool stiff_only = i >= errors.real;
    const T error =
        stiff_only ? zero : sensed(term.sense, errors.error[i] - T(term.shift[static_cast<std::size_t>(i)]));
    const T force = error * weight;
    // An error that does not count is not stiff either.
    const T stiffness =
        term.sense == Sense::equal || stiff_only ? weight : select(magnitude(error) > zero, weight, T(1e-300));
    const Wrench<T>& row = errors.row[i];
    pull += row.shift * force;
    turn += row.turn * force;
    if (term.base < 0) {
      load.add_row(row, force, stiffness);
      continue;
    }
    const V3<T> apart = segment.centre - figure.placed(term.base).centre;
    const V3<T> torque = errors.meets ? cross(errors.base_arm, row.shift) : row.turn + cross(apart, row.shift);
    const Wrench<T> back{-torque, -row.shift};
    load.slope += row * force;
    newton.load(term.base).slope += back * force;
    newton.add_tie(stiffness);
    newton.add_part(term.link, row);
    newton.add_part(term.base, back);
  }
  if (errors.is_force && (term.base < 0 || errors.meets)) load.add_second_order(errors.arm, pull);
  if (errors.meets) newton.load(term.base).add_second_order(errors.base_arm, -pull);
  if (term.base < 0 && errors.is_turn) add_second_order_turn(errors, turn, weight, load);
}

template <class T>
void pull(const Plan& plan, const Steps<T>& at, const Kinematics<T>& figure, Newton<T>& newton) {
  newton.clear();
  for (const Term& term : plan.terms) pull_term(plan, term, figure, newton);
  if (plan.sprung()) pull_rests(plan, at, figure, newton);
}

template <class T>
HWY_INLINE T cost_of(const Plan& plan, const Term& term, const Kinematics<T>& figure) {
  const T weight(term.weight), zero(0.0);
  if (term.kind == TermKind::balance) {
    const T error = most(stand(plan, term, figure, term.shift[0]).error, zero);
    return error * error * weight;
  }
  const Placed<T>& segment = figure.placed(term.link);
  if (term.kind == TermKind::point && term.base < 0) {
    const V3<T> miss = miss_of(term, segment, segment.rotation * V3<T>(term.point));
    return dot(miss, miss) * weight;
  }
  Base<T> base;
  if (term.base >= 0) base.placed = &figure.placed(term.base);
  Errors<T> errors;
  measure(term, segment, base, errors);
  T sum(0.0);
  for (int i = 0; i < std::min(errors.count, errors.real); ++i) {
    const T error = sensed(term.sense, errors.error[i] - T(term.shift[static_cast<std::size_t>(i)]));
    sum = sum + error * error;
  }
  return sum * weight;
}

// What is to be as small as can be: weight x error squared of all goals and springs.
template <class T>
T cost(const Plan& plan, const Steps<T>& at, const Kinematics<T>& figure, Newton<T>& newton) {
  T sum(0.0);
  for (const Term& term : plan.terms) sum = sum + cost_of(plan, term, figure);
  if (plan.sprung()) sum = sum + pull_rests(plan, at, figure, newton);
  return sum;
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
