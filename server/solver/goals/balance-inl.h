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
  T bend;                     // 1 / m, round a corner; of an edge 0
  // How the nearest part of the edge moves with each support: along the way, and along the level way to its left.
  V3<T> carry[kMostSupports], carry_left[kMostSupports];
};

template <class T>
Stand<T> stand(const Plan& plan, const Term& term, const Kinematics<T>& figure, double shift) {
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
    out.carry[k] = out.carry_left[k] = {zero, zero, zero};
  }
  out.error = out.bend = zero;
  out.way = {zero, zero, zero};
  for (int i = 0; i < lanes_of<T>(); ++i) {  // the hull is another in every lane
    Ground ground[kMostSupports];
    for (std::size_t k = 0; k < n; ++k) ground[k] = {lane(points[k].x, i), lane(points[k].y, i)};
    const Footing f = footing({ground, n}, {lane(mass.x, i), lane(mass.y, i)}, term.margin, -shift);
    set_lane(out.error, i, f.outside);
    set_lane(out.bend, i, f.round > 1e-9 ? 1.0 / f.round : 0.0);
    set_lane(out.way.x, i, f.way_x), set_lane(out.way.y, i, f.way_y);
    const auto add = [&](V3<T>& to, const Ground& normal, double by) HWY_ATTR {
      set_lane(to.x, i, lane(to.x, i) + normal.x * by), set_lane(to.y, i, lane(to.y, i) + normal.y * by);
    };
    for (const Footing::Edge& edge : f.edges) {
      if (edge.of_way == 0.0 && edge.of_left == 0.0) continue;
      add(out.carry[edge.first], edge.normal, (1.0 - edge.share) * edge.of_way);
      add(out.carry[edge.second], edge.normal, edge.share * edge.of_way);
      add(out.carry_left[edge.first], edge.normal, (1.0 - edge.share) * edge.of_left);
      add(out.carry_left[edge.second], edge.normal, edge.share * edge.of_left);
    }
  }
  return out;
}

// The places that move the centre of mass against its support, each with its share of `way`.
template <class T, class F>
void add_parts(const Plan& plan, const Term& term, const Kinematics<T>& figure, const Stand<T>& at, const V3<T>& way,
               const V3<T> (&carry)[kMostSupports], F part) {
  for (std::size_t i = 0; i < plan.links.size(); ++i) {
    const Link& link = plan.links[i];
    if (link.mass <= 0.0 || link.figure != term.figure) continue;
    part(static_cast<int>(i), figure.placed(static_cast<int>(i)).rotation * V3<T>(link.mass_point),
         way * T(link.mass / plan.masses[static_cast<std::size_t>(term.figure)]));
  }
  for (std::size_t k = 0; k < std::min(static_cast<std::size_t>(term.supports), kMostSupports); ++k)
    part(plan.supports[static_cast<std::size_t>(term.first_support) + k].link, at.arms[k], -carry[k]);
}

template <class T>
void pull_balance(const Plan& plan, const Term& term, const Kinematics<T>& figure, Newton<T>& newton) {
  const Stand<T> at = stand(plan, term, figure, term.shift[0]);
  const T zero(0.0), error = most(at.error, zero);
  const T weight(term.weight), force = error * weight;
  const auto add_row = [&](const V3<T>& way, const V3<T>(&carry)[kMostSupports], const T& stiffness, const T& pull) {
    newton.add_tie(stiffness);
    add_parts(plan, term, figure, at, way, carry, [&](int link, const V3<T>& arm, const V3<T>& shift) {
      const Wrench<T> row{cross(arm, shift), shift};
      newton.load(link).slope += row * pull;
      newton.load(link).add_second_order(arm, shift * pull);
      newton.add_part(link, row);
    });
  };
  // Ties are dear: what pulls in no lane has none.
  if (!any(error > zero)) return;
  const T little(1e-300);
  add_row(at.way, at.carry, select(error > zero, weight, little), force);
  const T round = force * at.bend;
  if (any(round > zero)) add_row({-at.way.y, at.way.x, zero}, at.carry_left, most(round, little), zero);
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
