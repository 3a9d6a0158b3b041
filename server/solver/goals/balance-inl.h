// The centre of mass stands over its support: how far it is outside (balance.h). It moves with every segment that has a
// mass, and so does the support.
#if defined(POSED_GOALS_BALANCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_GOALS_BALANCE_INL_H_
#undef POSED_GOALS_BALANCE_INL_H_
#else
#define POSED_GOALS_BALANCE_INL_H_
#endif

#include <algorithm>

#include "server/solver/goals/balance.h"
#include "server/solver/goals/errors-inl.h"
#include "server/solver/springs/newton-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
struct Stand {
  V3<T> way;                  // unit, level: straight out
  V3<T> arms[kMostSupports];  // of the supports, from their segments' centres
  T error;                    // m outside; below 0: inside
  T bend;                     // 1 / m, round a support; of an edge 0
  T shares[kMostSupports];    // how much of the nearest edge's place is each support's
};

template <class T>
Stand<T> stand(const Plan& plan, const Term& term, const Kinematics<T>& figure) {
  const T zero(0.0);
  V3<T> mass{zero, zero, zero};
  for (std::size_t i = 0; i < plan.links.size(); ++i) {
    const Link& link = plan.links[i];
    if (link.mass <= 0.0 || link.figure != term.figure) continue;
    const Placed<T>& placed = figure.placed(static_cast<int>(i));
    mass += (placed.centre + placed.rotation * V3<T>(link.mass_point)) *
            T(link.mass / plan.masses[static_cast<std::size_t>(term.figure)]);
  }
  Stand<T> out;
  const auto n = std::min(static_cast<std::size_t>(term.supports), kMostSupports);
  V3<T> points[kMostSupports];
  for (std::size_t k = 0; k < n; ++k) {
    const Support& support = plan.supports[static_cast<std::size_t>(term.first_support) + k];
    const Placed<T>& placed = figure.placed(support.link);
    out.arms[k] = placed.rotation * V3<T>(support.point);
    points[k] = placed.centre + out.arms[k];
    out.shares[k] = zero;
  }
  out.error = out.bend = zero;
  out.way = {zero, zero, zero};
  for (int i = 0; i < lanes_of<T>(); ++i) {  // the hull is another in every lane
    Ground ground[kMostSupports];
    for (std::size_t k = 0; k < n; ++k) ground[k] = {lane(points[k].x, i), lane(points[k].y, i)};
    const Footing f = footing({ground, n}, {lane(mass.x, i), lane(mass.y, i)}, term.margin);
    set_lane(out.error, i, f.outside);
    set_lane(out.bend, i, f.round > 1e-9 ? 1.0 / f.round : 0.0);
    set_lane(out.way.x, i, f.way_x), set_lane(out.way.y, i, f.way_y);
    set_lane(out.shares[f.second], i, f.share);
    set_lane(out.shares[f.first], i, lane(out.shares[f.first], i) + 1.0 - f.share);
  }
  return out;
}

// What moves the centre of mass against its support.
template <class T, class F>
void add_parts(const Plan& plan, const Term& term, const Kinematics<T>& figure, const Stand<T>& at, F part) {
  for (std::size_t i = 0; i < plan.links.size(); ++i) {
    const Link& link = plan.links[i];
    if (link.mass <= 0.0 || link.figure != term.figure) continue;
    part(static_cast<int>(i), figure.placed(static_cast<int>(i)).rotation * V3<T>(link.mass_point),
         T(link.mass / plan.masses[static_cast<std::size_t>(term.figure)]));
  }
  for (std::size_t k = 0; k < std::min(static_cast<std::size_t>(term.supports), kMostSupports); ++k) {
    part(plan.supports[static_cast<std::size_t>(term.first_support) + k].link, at.arms[k], -at.shares[k]);
  }
}

template <class T>
void pull_balance(const Plan& plan, const Term& term, const Kinematics<T>& figure, Newton<T>& newton) {
  const Stand<T> at = stand(plan, term, figure);
  const T zero(0.0), error = most(at.error - T(term.shift[0]), zero);
  const T weight(term.weight), force = error * weight;
  const auto add_row = [&](const V3<T>& way, const T& stiffness, const T& pull) {
    newton.add_tie(stiffness);
    add_parts(plan, term, figure, at, [&](int link, const V3<T>& arm, const T& share) {
      const V3<T> shift = way * share;
      const Wrench<T> row{cross(arm, shift), shift};
      newton.load(link).slope += row * pull;
      newton.load(link).add_second_order(arm, shift * pull);
      newton.add_part(link, row);
    });
  };
  const T little(1e-300);
  add_row(at.way, select(error > zero, weight, little), force);
  add_row({-at.way.y, at.way.x, zero}, most(force * at.bend, little), zero);
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
