// The touch point goes to a place: the vector between.
#if defined(POSED_GOALS_POSITION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_GOALS_POSITION_INL_H_
#undef POSED_GOALS_POSITION_INL_H_
#else
#define POSED_GOALS_POSITION_INL_H_
#endif

#include "server/solver/goals/errors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
HWY_INLINE void measure_position(const Term& term, const Placed<T>& segment, const Base<T>& base, Errors<T>& out) {
  out.arm = segment.rotation * V3<T>(term.point);
  out.is_force = out.meets = true;
  out.base_arm = base.arm(term.place);
  const V3<T> miss = segment.centre + out.arm - base.point(term.place);
  const T zero(0.0), one(1.0);
  out.add_along(miss.x, {one, zero, zero});
  out.add_along(miss.y, {zero, one, zero});
  out.add_along(miss.z, {zero, zero, one});
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
