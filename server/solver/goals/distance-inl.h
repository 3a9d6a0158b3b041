// The touch point is so far from a point of another segment. "At least" and "at most" count one side only.
#if defined(POSED_GOALS_DISTANCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_GOALS_DISTANCE_INL_H_
#undef POSED_GOALS_DISTANCE_INL_H_
#else
#define POSED_GOALS_DISTANCE_INL_H_
#endif

#include "server/solver/goals/errors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
HWY_INLINE void measure_distance(const Term& term, const Placed<T>& segment, const Base<T>& base, Errors<T>& out) {
  out.arm = segment.rotation * V3<T>(term.point);
  out.is_force = out.meets = true;
  out.base_arm = base.arm(term.place);
  const V3<T> between = segment.centre + out.arm - base.point(term.place);
  const T apart = root(dot(between, between)), tiny(1e-9);
  // Where both are at one place, every way apart is as good.
  const V3<T> way = select(apart > tiny, between * (T(1.0) / most(apart, tiny)), V3<T>(kZ));
  const T error = apart - T(term.length);
  out.add_along(error, way);
  // Too far apart, it resists a motion across as well.
  const T counts = most(sensed(term.sense, error), T(0.0));
  const T stiff = root(counts / most(apart, tiny));
  const V3<T> wish = select(magnitude(way.x) < T(0.7), V3<T>(kX), V3<T>(kY));
  V3<T> across = cross(way, wish);
  across = across * (stiff / root(dot(across, across)));
  for (const V3<T>& side : {across, cross(way, across)}) out.add_stiffness({cross(out.arm, side), side});
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
