// The touch point lies on a line: the vector from the line, along two directions across it.
#if defined(POSED_GOALS_LINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_GOALS_LINE_INL_H_
#undef POSED_GOALS_LINE_INL_H_
#else
#define POSED_GOALS_LINE_INL_H_
#endif

#include "server/solver/goals/errors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
HWY_INLINE void measure_line(const Term& term, const Placed<T>& segment, const Base<T>& base, Errors<T>& out) {
  out.arm = segment.rotation * V3<T>(term.point);
  out.is_force = true;
  const V3<T> miss = segment.centre + out.arm - base.point(term.place);
  const Vec3 across = perpendicular(term.direction, kX);
  for (const Vec3& way : {across, glm::cross(term.direction, across)}) {
    const V3<T> there = base.way(way);
    out.add_along(dot(miss, there), there);
  }
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
