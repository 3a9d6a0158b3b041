// Eight solves side by side: `Lanes` is a number for each, `double` is the same arithmetic for one alone. Kernels are
// templates over either. Compiled once for every instruction set (Highway); include guards toggle with it.
#if defined(POSED_SPRINGS_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_SPRINGS_LANES_INL_H_
#undef POSED_SPRINGS_LANES_INL_H_
#else
#define POSED_SPRINGS_LANES_INL_H_
#endif

#include <cmath>
#include <cstddef>
#include <type_traits>

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

// Loops over the rows of small matrices, which are registers once they are written out.
#ifndef POSED_UNROLL
#define POSED_UNROLL _Pragma("GCC unroll 8")
#endif

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr int kLanes = 8;
using Tag = hn::CappedTag<double, kLanes>;
inline constexpr std::size_t kWidth = HWY_LANES(double) < kLanes ? HWY_LANES(double) : kLanes;
inline constexpr std::size_t kParts = kLanes / kWidth;

struct LanesMask {
  hn::Mask<Tag> part[kParts];
};

// Said aloud: where the instruction set is not enabled, in std::allocator, GCC takes a vector's alignment for 16.
struct alignas(kWidth * sizeof(double)) Lanes {
  hn::Vec<Tag> part[kParts];

  Lanes() = default;
  HWY_INLINE Lanes(double all) {  // the same number in all lanes
    for (auto& p : part) p = hn::Set(Tag(), all);
  }
};

#define POSED_LANES_BINARY(name, operation)                                                   \
  HWY_INLINE Lanes name(const Lanes& a, const Lanes& b) {                                     \
    Lanes r;                                                                                  \
    for (std::size_t k = 0; k < kParts; ++k) r.part[k] = hn::operation(a.part[k], b.part[k]); \
    return r;                                                                                 \
  }
POSED_LANES_BINARY(operator+, Add)
POSED_LANES_BINARY(operator-, Sub)
POSED_LANES_BINARY(operator*, Mul)
POSED_LANES_BINARY(operator/, Div)
POSED_LANES_BINARY(least, Min)
POSED_LANES_BINARY(most, Max)
#undef POSED_LANES_BINARY

#define POSED_LANES_COMPARE(name, operation)                                                  \
  HWY_INLINE LanesMask name(const Lanes& a, const Lanes& b) {                                 \
    LanesMask r;                                                                              \
    for (std::size_t k = 0; k < kParts; ++k) r.part[k] = hn::operation(a.part[k], b.part[k]); \
    return r;                                                                                 \
  }
POSED_LANES_COMPARE(operator<, Lt)
POSED_LANES_COMPARE(operator>, Gt)
POSED_LANES_COMPARE(operator<=, Le)
POSED_LANES_COMPARE(operator>=, Ge)
#undef POSED_LANES_COMPARE

#define POSED_LANES_LOGIC(name, operation)                                                    \
  HWY_INLINE LanesMask name(const LanesMask& a, const LanesMask& b) {                         \
    LanesMask r;                                                                              \
    for (std::size_t k = 0; k < kParts; ++k) r.part[k] = hn::operation(a.part[k], b.part[k]); \
    return r;                                                                                 \
  }
POSED_LANES_LOGIC(operator&, And)
POSED_LANES_LOGIC(operator|, Or)
#undef POSED_LANES_LOGIC

HWY_INLINE LanesMask operator!(const LanesMask& a) {
  LanesMask r;
  for (std::size_t k = 0; k < kParts; ++k) r.part[k] = hn::Not(a.part[k]);
  return r;
}
HWY_INLINE Lanes operator-(const Lanes& a) {
  Lanes r;
  for (std::size_t k = 0; k < kParts; ++k) r.part[k] = hn::Neg(a.part[k]);
  return r;
}
HWY_INLINE Lanes root(const Lanes& a) {
  Lanes r;
  for (std::size_t k = 0; k < kParts; ++k) r.part[k] = hn::Sqrt(a.part[k]);
  return r;
}
HWY_INLINE Lanes magnitude(const Lanes& a) {
  Lanes r;
  for (std::size_t k = 0; k < kParts; ++k) r.part[k] = hn::Abs(a.part[k]);
  return r;
}
HWY_INLINE Lanes select(const LanesMask& mask, const Lanes& yes, const Lanes& no) {
  Lanes r;
  for (std::size_t k = 0; k < kParts; ++k) r.part[k] = hn::IfThenElse(mask.part[k], yes.part[k], no.part[k]);
  return r;
}
HWY_INLINE bool any(const LanesMask& a) {
  bool found = false;
  for (const auto& p : a.part) found |= !hn::AllFalse(Tag(), p);
  return found;
}

HWY_INLINE double least(double a, double b) {
  return a < b ? a : b;
}
HWY_INLINE double most(double a, double b) {
  return a > b ? a : b;
}
HWY_INLINE double root(double a) {
  return std::sqrt(a);
}
HWY_INLINE double magnitude(double a) {
  return std::abs(a);
}
HWY_INLINE double select(bool mask, double yes, double no) {
  return mask ? yes : no;
}
HWY_INLINE bool any(bool a) {
  return a;
}

template <class T>
struct MaskOf {
  using type = bool;
};
template <>
struct MaskOf<Lanes> {
  using type = LanesMask;
};
template <class T>
using Mask = typename MaskOf<T>::type;

// Lane `i` of one value.
HWY_INLINE double lane(const Lanes& a, int i) {
  alignas(64) double values[kLanes];
  for (std::size_t k = 0; k < kParts; ++k) hn::Store(a.part[k], Tag(), values + k * kWidth);
  return values[i];
}
HWY_INLINE double lane(double a, int) {
  return a;
}
HWY_INLINE void set_lane(Lanes& a, int i, double value) {
  alignas(64) double values[kLanes];
  for (std::size_t k = 0; k < kParts; ++k) hn::Store(a.part[k], Tag(), values + k * kWidth);
  values[i] = value;
  for (std::size_t k = 0; k < kParts; ++k) a.part[k] = hn::Load(Tag(), values + k * kWidth);
}
HWY_INLINE void set_lane(double& a, int, double value) {
  a = value;
}

template <class T>
constexpr int lanes_of() {
  return std::is_same_v<T, Lanes> ? kLanes : 1;
}

HWY_INLINE Lanes arc_tangent(const Lanes& a) {
  Lanes r;
  for (std::size_t k = 0; k < kParts; ++k) r.part[k] = hn::Atan(Tag(), a.part[k]);
  return r;
}
HWY_INLINE double arc_tangent(double a) {
  return std::atan(a);
}
HWY_INLINE void sine_and_cosine(const Lanes& a, Lanes& sine, Lanes& cosine) {
  for (std::size_t k = 0; k < kParts; ++k)
    sine.part[k] = hn::Sin(Tag(), a.part[k]), cosine.part[k] = hn::Cos(Tag(), a.part[k]);
}
HWY_INLINE void sine_and_cosine(double a, double& sine, double& cosine) {
  sine = std::sin(a), cosine = std::cos(a);
}

// Sines and cosines of `n` numbers (or lanes of them) in one sweep. Memory beyond n is written up to a whole vector.
template <class T>
HWY_INLINE void sines(const T* angles, std::size_t n, T* sine, T* cosine) {
  const Tag d;
  const double* in = reinterpret_cast<const double*>(angles);
  double* s = reinterpret_cast<double*>(sine);
  double* c = reinterpret_cast<double*>(cosine);
  for (std::size_t i = 0; i < n * static_cast<std::size_t>(lanes_of<T>()); i += kWidth) {
    const auto x = hn::LoadU(d, in + i);
    hn::StoreU(hn::Sin(d, x), d, s + i);
    hn::StoreU(hn::Cos(d, x), d, c + i);
  }
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
