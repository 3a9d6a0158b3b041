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

template <class T>
T pull_posture(const Plan& plan, const Steps<T>& at, const Kinematics<T>& figure, Newton<T>& newton) {
  T cost(0.0);
  for (std::size_t i = 0; i < plan.links.size(); ++i) {
    const Link& link = plan.links[i];
    const auto first = static_cast<std::size_t>(link.dof), more = static_cast<std::size_t>(link.more);
    if (link.dofs == 0) continue;
    const T weight(plan.springs[first].weight);
    const auto hold = [&](std::size_t j, const T& error) {
      const T w(plan.springs[j].weight);
      newton.spring_slope(j) = error * w;
      cost = cost + error * error * w;
    };
    if (link.kind == LinkKind::axes) {
      for (std::size_t j = first; j < first + static_cast<std::size_t>(link.dofs); ++j)
        hold(j, at.turns[j] - T(plan.springs[j].turn));
    } else if (link.kind == LinkKind::limb) {
      T q[4];
      limb_quaternion(link, {at.more[more], at.more[more + 1], at.more[more + 2]}, at.turns[first + 2], q);
      const V3<T> off = turn_between(&plan.spring_more[more], q);
      const Swinging<T>& s = figure.swinging(i);
      cost = cost + dot(off, off) * weight;
      newton.spring_slope(first) = dot(off, s.turn_out) * weight;
      newton.spring_slope(first + 1) = dot(off, s.turn_along) * weight;
      newton.spring_slope(first + 2) = dot(off, s.direction) * weight;
    } else {
      const bool floats = link.kind == LinkKind::floating;
      const std::size_t q = more + (floats ? 3 : 0), turn = first + (floats ? 3 : 0);
      const V3<T> off = turn_between(&plan.spring_more[q], &at.more[q]);
      hold(turn, off.x), hold(turn + 1, off.y), hold(turn + 2, off.z);
      for (std::size_t k = 0; floats && k < 3; ++k) hold(first + k, at.more[more + k] - T(plan.spring_more[more + k]));
    }
  }
  return cost;
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
