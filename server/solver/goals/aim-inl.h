// An axis of the segment points at a point or along a direction: the angle between as a vector across the axis, times
// the lever.
#if defined(POSED_GOALS_AIM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_GOALS_AIM_INL_H_
#undef POSED_GOALS_AIM_INL_H_
#else
#define POSED_GOALS_AIM_INL_H_
#endif

#include "server/solver/goals/errors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
HWY_INLINE void measure_aim(const Term& term, const Placed<T>& segment, const Base<T>& base, Errors<T>& out) {
  const T zero(0.0), one(1.0), tiny(1e-9), lever(term.lever);
  const V3<T> axis = segment.rotation * V3<T>(term.axis);
  out.arm = segment.rotation * V3<T>(term.point);
  V3<T> wanted;
  T nearness = zero;  // one over the distance
  if (term.at_point) {
    const V3<T> way = base.point(term.place) - segment.centre - out.arm;
    nearness = one / most(root(dot(way, way)), tiny);
    wanted = way * nearness;
  } else {
    wanted = base.way(term.direction);
  }
  // Turning about `normal` would close the angle; `across` completes the frame of the axis.
  const V3<T> c = cross(axis, wanted);
  const T sine = root(dot(c, c)), cosine = dot(axis, wanted);
  const Mask<T> opposite = (sine < T(1e-12)) & (cosine < zero);
  const T angle = select(opposite, T(M_PI), T(2.0) * arc_tangent(sine / most(one + cosine, T(1e-300))));
  const V3<T> any = segment.rotation * V3<T>(perpendicular(term.axis, kX));
  const V3<T> normal = select(sine > tiny, c * (one / most(sine, tiny)), any);
  const V3<T> across = cross(axis, normal);
  // The angle falls by the turn about `normal`; the axis drifts sideways by the turn about `across`, which an angle of
  // more than a quarter turn reaches on a shorter way.
  const T side = select(sine > T(1e-6), most(angle * cosine / most(sine, T(1e-6)), zero), one);
  // A shift of the touch point turns the wanted direction by wanted x (-shift) / distance.
  const V3<T> shift_normal = cross(normal, wanted) * nearness, shift_across = cross(across, wanted) * nearness;
  const T root_side = root(side);
  out.is_turn = out.tips = true;
  out.tip = axis, out.tip_way = across * lever;
  const auto row = [&](const V3<T>& turn, const V3<T>& shift, const T& scale) {
    return Wrench<T>{(turn + cross(out.arm, shift)) * scale, shift * scale};
  };
  out.add(angle * lever, row(-normal, -shift_normal, lever));
  out.add_stiffness(row(across, shift_across, lever * root_side));
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
