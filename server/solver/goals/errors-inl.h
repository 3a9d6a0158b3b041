// What every kind of goal tells: up to three errors, and how each changes with the motion of the segment that the goal
// holds. A goal that is relative to another segment changes by the motion of one against the other.
#if defined(POSED_GOALS_ERRORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_GOALS_ERRORS_INL_H_
#undef POSED_GOALS_ERRORS_INL_H_
#else
#define POSED_GOALS_ERRORS_INL_H_
#endif

#include "server/solver/springs/kinematics-inl.h"
#include "server/solver/springs/load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
struct Errors {
  int count = 0;
  T error[3];             // m
  Wrench<T> row[3];       // d error / d (turn, shift of the segment's centre)
  int stiff_only = -1;    // the error that is none
  V3<T> arm;              // where the goal's force takes hold, from the segment's centre
  bool is_force = false;  // it is a force at `arm` and no torque

  HWY_INLINE void add(const T& e, const Wrench<T>& r) {
    error[count] = e;
    row[count++] = r;
  }
  // What is no error, but stiff: its row counts in the matrix alone.
  HWY_INLINE void add_stiffness(const Wrench<T>& r) {
    stiff_only = count;
    add(T(0.0), r);
  }
  // The change of a distance along `way` (unit or zero) of a point at `arm`.
  HWY_INLINE void add_along(const T& e, const V3<T>& way) { add(e, {cross(arm, way), way}); }
};

// The frame of a goal: a link's, or the world.
template <class T>
struct Base {
  const Placed<T>* placed = nullptr;

  HWY_INLINE V3<T> point(const Vec3& p) const {
    return placed ? placed->centre + placed->rotation * V3<T>(p) : V3<T>(p);
  }
  HWY_INLINE V3<T> way(const Vec3& v) const { return placed ? placed->rotation * V3<T>(v) : V3<T>(v); }
  HWY_INLINE M3<T> rotation(const Quat& q) const { return placed ? placed->rotation * matrix<T>(q) : matrix<T>(q); }
};

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
