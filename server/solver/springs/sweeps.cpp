#include "server/solver/springs/sweeps.h"

#include "server/solver/springs/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/solver/springs/sweeps.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include "server/solver/springs/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

void arc_tangents_here(const double* y, const double* x, std::size_t n, double* angle) {
  const Tag d;
  const auto pi = hn::Set(d, M_PI), quarter = hn::Set(d, 0.5 * M_PI), least = hn::Set(d, 1e-300);
  for (std::size_t i = 0; i < n; i += kWidth) {
    const auto over = hn::LoadU(d, y + i), under = hn::LoadU(d, x + i);
    const auto a = hn::Abs(over), b = hn::Abs(under);
    const auto first = hn::Atan(d, hn::Div(hn::Min(a, b), hn::Max(hn::Max(a, b), least)));
    const auto eighth = hn::IfThenElse(hn::Gt(a, b), hn::Sub(quarter, first), first);
    const auto half = hn::IfThenElse(hn::Lt(under, hn::Zero(d)), hn::Sub(pi, eighth), eighth);
    hn::StoreU(hn::CopySign(half, over), d, angle + i);
  }
}

void half_sines_here(const double* angle, std::size_t n, double* sine, double* cosine) {
  const Tag d;
  const auto half = hn::Set(d, 0.5);
  for (std::size_t i = 0; i < n; i += kWidth) {
    const auto x = hn::Mul(hn::LoadU(d, angle + i), half);
    hn::StoreU(hn::Sin(d, x), d, sine + i);
    hn::StoreU(hn::Cos(d, x), d, cosine + i);
  }
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posed::springs {

HWY_EXPORT(arc_tangents_here);
HWY_EXPORT(half_sines_here);

void arc_tangents(const double* y, const double* x, std::size_t n, double* angle) {
  HWY_DYNAMIC_DISPATCH(arc_tangents_here)(y, x, n, angle);
}
void half_sines(const double* angle, std::size_t n, double* sine, double* cosine) {
  HWY_DYNAMIC_DISPATCH(half_sines_here)(angle, n, sine, cosine);
}

}  // namespace posed::springs
#endif
