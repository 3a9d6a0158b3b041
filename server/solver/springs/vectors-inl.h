// Vectors and matrices of a lane type, with only what the kernels need.
#if defined(POSED_SPRINGS_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_SPRINGS_VECTORS_INL_H_
#undef POSED_SPRINGS_VECTORS_INL_H_
#else
#define POSED_SPRINGS_VECTORS_INL_H_
#endif

#include "common/math.h"
#include "server/solver/springs/lanes-inl.h"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // all of it is inlined: nothing is passed between calls
#elif defined(__clang__)
#pragma clang diagnostic ignored "-Wbitwise-instead-of-logical"  // masks are bool for one alone
#endif

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
struct V3 {
  T x, y, z;

  V3() = default;
  HWY_INLINE V3(T a, T b, T c) : x(a), y(b), z(c) {}
  HWY_INLINE explicit V3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}

  HWY_INLINE V3 operator+(const V3& b) const { return {x + b.x, y + b.y, z + b.z}; }
  HWY_INLINE V3 operator-(const V3& b) const { return {x - b.x, y - b.y, z - b.z}; }
  HWY_INLINE V3 operator-() const { return {-x, -y, -z}; }
  HWY_INLINE V3 operator*(const T& s) const { return {x * s, y * s, z * s}; }
  HWY_INLINE V3& operator+=(const V3& b) { return *this = *this + b; }
  HWY_INLINE V3& operator-=(const V3& b) { return *this = *this - b; }
};

// One alone keeps a vector in one register, where the instruction set has any that wide.
template <>
struct alignas(32) V3<double> {  // said aloud: see Lanes
  using Wide = double __attribute__((vector_size(32)));
  union {
    Wide all;
    __extension__ struct { double x, y, z, unused; };
  };

  V3() = default;
  HWY_INLINE V3(double a, double b, double c) : all{a, b, c, 0.0} {}
  HWY_INLINE explicit V3(const Vec3& v) : all{v.x, v.y, v.z, 0.0} {}
  HWY_INLINE explicit V3(const Wide& wide) : all(wide) {}

  HWY_INLINE V3 operator+(const V3& b) const { return V3(all + b.all); }
  HWY_INLINE V3 operator-(const V3& b) const { return V3(all - b.all); }
  HWY_INLINE V3 operator-() const { return V3(-all); }
  HWY_INLINE V3 operator*(double s) const { return V3(all * s); }
  HWY_INLINE V3& operator+=(const V3& b) {
    all += b.all;
    return *this;
  }
  HWY_INLINE V3& operator-=(const V3& b) {
    all -= b.all;
    return *this;
  }
  HWY_INLINE double sum() const { return x + y + z; }
  HWY_INLINE V3 yzx() const { return V3(__builtin_shufflevector(all, all, 1, 2, 0, 3)); }
};

HWY_INLINE V3<double> cross(const V3<double>& a, const V3<double>& b) {
  return V3<double>(a.all * b.yzx().all - a.yzx().all * b.all).yzx();
}
HWY_INLINE V3<double> select(bool mask, const V3<double>& yes, const V3<double>& no) {
  return mask ? yes : no;
}

template <class T>
HWY_INLINE T dot(const V3<T>& a, const V3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
HWY_INLINE V3<T> cross(const V3<T>& a, const V3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
HWY_INLINE V3<T> select(const Mask<T>& mask, const V3<T>& yes, const V3<T>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

// By its columns.
template <class T>
struct M3 {
  V3<T> x, y, z;

  HWY_INLINE V3<T> operator*(const V3<T>& v) const { return x * v.x + y * v.y + z * v.z; }
  HWY_INLINE M3 operator*(const M3& b) const { return {*this * b.x, *this * b.y, *this * b.z}; }
  HWY_INLINE M3& operator+=(const M3& b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  // Transposed, times v.
  HWY_INLINE V3<T> turned_back(const V3<T>& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};

template <class T>
HWY_INLINE M3<T> matrix(const Quat& q) {
  return {V3<T>(q * kX), V3<T>(q * kY), V3<T>(q * kZ)};
}

// Of a unit quaternion x y z w.
template <class T>
HWY_INLINE M3<T> matrix(const T& x, const T& y, const T& z, const T& w) {
  const T x2 = x + x, y2 = y + y, z2 = z + z, one(1.0);
  const T xx = x * x2, yy = y * y2, zz = z * z2, xy = x * y2, xz = x * z2, yz = y * z2, wx = w * x2, wy = w * y2,
          wz = w * z2;
  return {{one - yy - zz, xy + wz, xz - wy}, {xy - wz, one - xx - zz, yz + wx}, {xz + wy, yz - wx, one - xx - yy}};
}

// Symmetric.
template <class T>
struct S3 {
  T xx, xy, xz, yy, yz, zz;

  HWY_INLINE V3<T> operator*(const V3<T>& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }
  HWY_INLINE S3& operator+=(const S3& b) {
    xx = xx + b.xx, xy = xy + b.xy, xz = xz + b.xz, yy = yy + b.yy, yz = yz + b.yz, zz = zz + b.zz;
    return *this;
  }
  // += s a b' for a b' that is known to be symmetric.
  HWY_INLINE void add_outer(const V3<T>& a, const V3<T>& b) {
    xx = xx + a.x * b.x, xy = xy + a.x * b.y, xz = xz + a.x * b.z;
    yy = yy + a.y * b.y, yz = yz + a.y * b.z, zz = zz + a.z * b.z;
  }
};

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
