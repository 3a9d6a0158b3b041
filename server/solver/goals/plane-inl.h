// The touch point lies on a plane: its distance, positive on the side of the normal. "Above" counts what is below 0.
#if defined(POSED_GOALS_PLANE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_GOALS_PLANE_INL_H_
#undef POSED_GOALS_PLANE_INL_H_
#else
#define POSED_GOALS_PLANE_INL_H_
#endif

#include "server/solver/goals/errors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
HWY_INLINE void measure_plane(const Term& term, const Placed<T>& segment, const Base<T>& base, Errors<T>& out) {
  out.arm = segment.rotation * V3<T>(term.point);
  out.is_force = true;
  const V3<T> normal = base.way(term.direction);
  out.add_along(dot(segment.centre + out.arm - base.point(term.place), normal), normal);
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
