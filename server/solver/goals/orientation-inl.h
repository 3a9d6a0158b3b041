// The segment turns as it is told: the rotation vector from there, times the lever (Sola, Deray and Atchuthan, "A micro
// Lie theory for state estimation in robotics", 2018, for the logarithm and its derivative).
#if defined(POSED_GOALS_ORIENTATION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_GOALS_ORIENTATION_INL_H_
#undef POSED_GOALS_ORIENTATION_INL_H_
#else
#define POSED_GOALS_ORIENTATION_INL_H_
#endif

#include "server/solver/goals/errors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
struct RotationVector {
  V3<T> vector;
  T angle;
};

template <class T>
HWY_INLINE RotationVector<T> rotation_vector(const M3<T>& r) {
  const T half(0.5), tiny(1e-9);
  const V3<T> v{(r.y.z - r.z.y) * half, (r.z.x - r.x.z) * half, (r.x.y - r.y.x) * half};  // sine x axis
  const T sine = root(dot(v, v)), cosine = (r.x.x + r.y.y + r.z.z - T(1.0)) * half;
  const T angle = T(2.0) * arc_tangent(sine / most(T(1.0) + cosine, T(1e-300)));
  // Half a turn has no sine: the axis is the longest column of R + 1.
  const T one(1.0);
  const V3<T> x{r.x.x + one, r.x.y, r.x.z}, y{r.y.x, r.y.y + one, r.y.z}, z{r.z.x, r.z.y, r.z.z + one};
  V3<T> axis = select((r.x.x >= r.y.y) & (r.x.x >= r.z.z), x, select(r.y.y >= r.z.z, y, z));
  axis = axis * (one / most(root(dot(axis, axis)), T(1e-300)));
  const Mask<T> half_turn = (sine < T(1e-7)) & (cosine < T(0.0));
  const T scale = select(sine > tiny, angle / most(sine, tiny), one);
  return {select(half_turn, axis * T(M_PI), v * scale), select(half_turn, T(M_PI), angle)};
}

template <class T>
HWY_INLINE void measure_orientation(const Term& term, const Placed<T>& segment, const Base<T>& base, Errors<T>& out) {
  const M3<T> wanted = base.rotation(term.rotation);
  // world_from_segment wanted'
  M3<T> off;
  const M3<T>& s = segment.rotation;
  off.x = s.x * wanted.x.x + s.y * wanted.y.x + s.z * wanted.z.x;
  off.y = s.x * wanted.x.y + s.y * wanted.y.y + s.z * wanted.z.y;
  off.z = s.x * wanted.x.z + s.y * wanted.y.z + s.z * wanted.z.z;
  const RotationVector<T> r = rotation_vector(off);
  const T lever(term.lever), zero(0.0), one(1.0), small(1e-4);
  // d vector / d turn = 1 - [v] / 2 + k [v] [v]
  const T half_angle = r.angle * T(0.5);
  T half_sine, half_cosine;
  sine_and_cosine(half_angle, half_sine, half_cosine);
  const T square = most(r.angle * r.angle, small * small);
  const T k = select(r.angle > small, (one - half_angle * half_cosine / most(half_sine, small * T(0.5))) / square,
                     T(1.0 / 12.0));
  const V3<T>& v = r.vector;
  const T vv = dot(v, v);
  out.arm = {zero, zero, zero};
  // Across the vector the rows' square is (a / sin a)^2, with a half the angle; the Hessian is a / tan a.
  out.is_turn = true;
  out.excess = select(r.angle > small,
                      half_angle * (half_angle / most(half_sine, small * T(0.5)) - half_cosine) /
                          most(half_sine, small * T(0.5)),
                      zero) *
               lever * lever;
  const V3<T> unit[3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
  const T part[3] = {v.x, v.y, v.z};
  for (int i = 0; i < 3; ++i) {
    // Row i: e_i + (v x e_i)' / 2 + k (v_i v - v'v e_i)'
    const V3<T> row = unit[i] * (one - k * vv) + cross(v, unit[i]) * T(0.5) + v * (k * part[i]);
    out.add(part[i] * lever, {row * lever, {zero, zero, zero}});
  }
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
