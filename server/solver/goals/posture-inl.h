// Joints rest where a spring of their own holds them: the angle from there (of a ball, limb or root: the rotation
// vector).
#if defined(POSED_GOALS_POSTURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_GOALS_POSTURE_INL_H_
#undef POSED_GOALS_POSTURE_INL_H_
#else
#define POSED_GOALS_POSTURE_INL_H_
#endif

#include "server/solver/goals/orientation-inl.h"
#include "server/solver/springs/newton-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

// Of unit quaternions x y z w: the rotation vector that carries `rest` to `at`.
template <class T>
HWY_INLINE V3<T> turn_between(const double* rest, const T* at) {
  const V3<T> r{T(-rest[0]), T(-rest[1]), T(-rest[2])}, a{at[0], at[1], at[2]};
  const T rw(rest[3]), zero(0.0), one(1.0);
  V3<T> v = a * rw + r * at[3] + cross(a, r);
  T w = at[3] * rw - dot(a, r);
  const T sign = select(w < zero, -one, one);
  v = v * sign;
  w = w * sign;
  const T sine = root(dot(v, v)), tiny(1e-9);
  return v * select(sine > tiny, T(2.0) * arc_tangent(sine / most(w, T(1e-300))) / most(sine, tiny), T(2.0));
}

// The quaternion of a limb: its swing after its twist.
template <class T>
HWY_INLINE void limb_quaternion(const Link& link, const V3<T>& direction, const T& twist, T* out) {
  const V3<T> p(link.limb);
  const T w = T(1.0) + dot(p, direction);
  const V3<T> v = cross(p, direction);
  const T length = T(1.0) / root(most(w * w + dot(v, v), T(1e-300)));
  T s, c;
  sine_and_cosine(twist * T(0.5), s, c);
  const V3<T> swing = v * length, twisted = p * s;
  const T sw = w * length;
  const V3<T> r = swing * c + twisted * sw + cross(swing, twisted);
  out[0] = r.x, out[1] = r.y, out[2] = r.z, out[3] = sw * c - dot(swing, twisted);
}

// Adds the slopes of one rest; its cost.
template <class T>
HWY_INLINE T pull_rest(const Plan& plan, const Rest& rest, const Steps<T>& at, const Kinematics<T>& figure,
                       Newton<T>& newton) {
  const auto i = static_cast<std::size_t>(rest.link);
  const Link& link = plan.links[i];
  const auto first = static_cast<std::size_t>(link.dof), more = static_cast<std::size_t>(link.more);
  T cost(0.0);
  const auto hold = [&](std::size_t k, const T& error) {
    const T pull = error * T(rest.weight[k]);
    newton.spring_slope(first + k) = newton.spring_slope(first + k) + pull;
    cost = cost + error * pull;
  };
  if (link.kind == LinkKind::axes) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(link.dofs); ++k) hold(k, at.turns[first + k] - T(rest.at[k]));
  } else if (link.kind == LinkKind::limb) {
    T q[4];
    limb_quaternion(link, {at.more[more], at.more[more + 1], at.more[more + 2]}, at.turns[first + 2], q);
    const T weight(rest.weight[0]);
    const V3<T> off = turn_between(rest.at.data(), q), pull = off * weight;
    const Swinging<T>& s = figure.swinging(i);
    const V3<T>* const ways[3] = {&s.turn_out, &s.turn_along, &s.direction};
    for (std::size_t k = 0; k < 3; ++k)
      newton.spring_slope(first + k) = newton.spring_slope(first + k) + dot(pull, *ways[k]);
    cost = dot(off, pull);
  } else if (link.dofs > 0) {
    const std::size_t place = link.kind == LinkKind::floating ? 3 : 0;
    for (std::size_t k = 0; k < place; ++k) hold(k, at.more[more + k] - T(rest.at[k]));
    const V3<T> off = turn_between(&rest.at[place], &at.more[more + place]);
    hold(place, off.x), hold(place + 1, off.y), hold(place + 2, off.z);
  }
  return cost;
}

// All rests: their slopes anew.
template <class T>
T pull_rests(const Plan& plan, const Steps<T>& at, const Kinematics<T>& figure, Newton<T>& newton) {
  newton.clear_springs();
  T cost(0.0);
  for (const Rest& rest : plan.rests) cost = cost + pull_rest(plan, rest, at, figure, newton);
  return cost;
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
