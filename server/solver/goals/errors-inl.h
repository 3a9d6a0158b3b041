// What every kind of goal tells: up to three errors, and how each changes with the motion of the segment that the goal
// holds. A goal that is relative to another segment changes by the motion of one against the other.
#if defined(POSED_GOALS_ERRORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_GOALS_ERRORS_INL_H_
#undef POSED_GOALS_ERRORS_INL_H_
#else
#define POSED_GOALS_ERRORS_INL_H_
#endif

#include <algorithm>

#include "server/solver/springs/kinematics-inl.h"
#include "server/solver/springs/load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

// The part of an error that counts.
template <class T>
HWY_INLINE T sensed(Sense sense, const T& error) {
  const T zero(0.0);
  return sense == Sense::equal ? error : sense == Sense::at_least ? least(error, zero) : most(error, zero);
}

template <class T>
struct Errors {
  Wrench<T> row[3];  // d error / d (turn, shift of the segment's centre)
  V3<T> arm;         // where the goal's force takes hold, from the segment's centre
  V3<T> base_arm;    // see `meets`
  V3<T> tip, tip_way;
  T error[3];  // m
  T excess;
  int count = 0;
  int real = 3;           // rows from here on are no errors, but stiff: they count in the matrix alone
  bool is_force = false;  // it is a force at `arm` and no torque
  // Relative to a segment: the force is met at a point of that one, `base_arm` from its centre, and not where it takes
  // hold.
  bool meets = false;
  // A turn's terms of second order: how it pulls the tip of an axis (Load::add_second_order_tip), or else by how much
  // its rows' square is too much across its torque (add_second_order_torque).
  bool is_turn = false, tips = false;

  HWY_INLINE void add(const T& e, const Wrench<T>& r) {
    error[count] = e;
    row[count++] = r;
  }
  // After all errors.
  HWY_INLINE void add_stiffness(const Wrench<T>& r) {
    real = std::min(real, count);
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
  // From the centre of the link.
  HWY_INLINE V3<T> arm(const Vec3& p) const { return placed ? placed->rotation * V3<T>(p) : V3<T>(p); }
  HWY_INLINE V3<T> way(const Vec3& v) const { return placed ? placed->rotation * V3<T>(v) : V3<T>(v); }
  HWY_INLINE M3<T> rotation(const Quat& q) const { return placed ? placed->rotation * matrix<T>(q) : matrix<T>(q); }
};

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
