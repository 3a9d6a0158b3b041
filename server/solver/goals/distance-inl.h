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
  out.is_force = true;
  const V3<T> between = segment.centre + out.arm - base.point(term.place);
  const T apart = root(dot(between, between)), tiny(1e-9);
  // Where both are at one place, every way apart is as good.
  const V3<T> way = select(apart > tiny, between * (T(1.0) / most(apart, tiny)), V3<T>(kZ));
  out.add_along(apart - T(term.length), way);
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
