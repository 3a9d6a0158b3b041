// The quadratic that a segment's motion has to answer for: all goals on it and below it.
#if defined(POSED_SPRINGS_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_SPRINGS_LOAD_INL_H_
#undef POSED_SPRINGS_LOAD_INL_H_
#else
#define POSED_SPRINGS_LOAD_INL_H_
#endif

#include "server/solver/springs/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

// A force and its torque about a segment's centre, or a motion of that centre and its turn.
template <class T>
struct Wrench {
  V3<T> turn, shift;

  HWY_INLINE void clear() { turn = shift = V3<T>{T(0.0), T(0.0), T(0.0)}; }
  HWY_INLINE Wrench& operator+=(const Wrench& b) {
    turn += b.turn, shift += b.shift;
    return *this;
  }
  HWY_INLINE Wrench operator*(const T& s) const { return {turn * s, shift * s}; }
};
template <class T>
HWY_INLINE T dot(const Wrench<T>& a, const Wrench<T>& b) {
  return dot(a.turn, b.turn) + dot(a.shift, b.shift);
}
HWY_INLINE double dot(const Wrench<double>& a, const Wrench<double>& b) {
  return V3<double>(a.turn.all * b.turn.all + a.shift.all * b.shift.all).sum();
}

// m' M m / 2 + m' slope, with m the motion of the segment's own centre and M in blocks. `pull` and `moment` carry the
// terms of second order: see bend().
template <class T>
struct Load {
  S3<T> turn_turn;
  M3<T> turn_shift;  // columns: by the shift's axis
  S3<T> shift_shift;
  Wrench<T> slope;
  V3<T> pull;    // sum of weight x error over all below
  M3<T> moment;  // sum of (point - centre) (weight x error)'

  HWY_INLINE void clear() {
    const T zero(0.0);
    const V3<T> none{zero, zero, zero};
    turn_turn = shift_shift = {zero, zero, zero, zero, zero, zero};
    turn_shift = moment = {none, none, none};
    slope.clear();
    pull = none;
  }

  // An error vector at a point, `arm` from the centre; `force` is weight x error.
  HWY_INLINE void add_point(const V3<T>& arm, const V3<T>& force, const T& weight) {
    const V3<T> wa = arm * weight;
    const T xx = wa.x * arm.x, yy = wa.y * arm.y, zz = wa.z * arm.z;
    turn_turn.xx = turn_turn.xx + (yy + zz), turn_turn.yy = turn_turn.yy + (xx + zz);
    turn_turn.zz = turn_turn.zz + (xx + yy);
    turn_turn.xy = turn_turn.xy - wa.x * arm.y, turn_turn.xz = turn_turn.xz - wa.x * arm.z;
    turn_turn.yz = turn_turn.yz - wa.y * arm.z;
    turn_shift.x.y = turn_shift.x.y + wa.z, turn_shift.x.z = turn_shift.x.z - wa.y;
    turn_shift.y.x = turn_shift.y.x - wa.z, turn_shift.y.z = turn_shift.y.z + wa.x;
    turn_shift.z.x = turn_shift.z.x + wa.y, turn_shift.z.y = turn_shift.z.y - wa.x;
    shift_shift.xx = shift_shift.xx + weight, shift_shift.yy = shift_shift.yy + weight;
    shift_shift.zz = shift_shift.zz + weight;
    slope += {cross(arm, force), force};
    add_second_order(arm, force);
  }

  // One error that changes by `row` with the segment's motion; `force` is weight x error.
  HWY_INLINE void add_row(const Wrench<T>& row, const T& force, const T& weight) {
    const V3<T> wt = row.turn * weight, ws = row.shift * weight;
    turn_turn.add_outer(wt, row.turn);
    turn_shift.x += wt * row.shift.x, turn_shift.y += wt * row.shift.y, turn_shift.z += wt * row.shift.z;
    shift_shift.add_outer(ws, row.shift);
    slope += row * force;
  }

  HWY_INLINE void add_second_order(const V3<T>& arm, const V3<T>& force) {
    pull += force;
    moment.x += arm * force.x, moment.y += arm * force.y, moment.z += arm * force.z;
  }

  // Of an error in the direction of an axis: `way` is the slope for its tip.
  HWY_INLINE void add_second_order_tip(const V3<T>& tip, const V3<T>& way) {
    moment.x += tip * way.x, moment.y += tip * way.y, moment.z += tip * way.z;
  }
  // Of an error in turn: two turns one after the other make a third half of the way across; less `excess` times
  // torque's square about all that is across it.
  HWY_INLINE void add_second_order_torque(const V3<T>& torque, const T& excess) {
    const V3<T> half = torque * T(0.5), more = torque * excess;
    moment.x += V3<T>{T(0.0), -half.z, half.y} + torque * more.x;
    moment.y += V3<T>{half.z, T(0.0), -half.x} + torque * more.y;
    moment.z += V3<T>{-half.y, half.x, T(0.0)} + torque * more.z;
  }

  // What a turn of the joint about `axis` adds to the slope of all turns above it, and to its own: the exact terms of
  // second order. For d/dq_i d/dq_j with i above j they are axis_i . bend(axis_j).
  HWY_INLINE V3<T> bend(const V3<T>& axis) const { return moment * axis - axis * trace(); }
  HWY_INLINE T trace() const { return moment.x.x + moment.y.y + moment.z.z; }

  // The matrix times a turn about `axis`, or a shift along it, with `newton` times the terms of second order.
  HWY_INLINE void times_turn(const V3<T>& axis, const T& newton, V3<T>& turn, V3<T>& shift) const {
    turn = turn_turn * axis + bend(axis) * newton;
    shift = turn_shift.turned_back(axis);
  }
  HWY_INLINE void times_shift(const V3<T>& axis, const T& newton, V3<T>& turn, V3<T>& shift) const {
    turn = turn_shift * axis + cross(axis, pull) * newton;
    shift = shift_shift * axis;
  }

  // Takes out a degree of freedom that moves everything here by `axis` (u and w: the matrix times it).
  HWY_INLINE void take_out(const V3<T>& u, const V3<T>& w, const T& inverse, const T& share) {
    const V3<T> us = u * inverse, ws = w * inverse;
    turn_turn.add_outer(-us, u);
    turn_shift.x -= us * w.x, turn_shift.y -= us * w.y, turn_shift.z -= us * w.z;
    shift_shift.add_outer(-ws, w);
    slope.turn -= u * share;
    slope.shift -= w * share;
  }

  // Adds this to the load of the segment above; `arm` points from its centre to ours. The terms of second order are
  // left out where `newton` is 0.
  HWY_INLINE void hand_down(const V3<T>& arm, const T& newton, Load& to) const {
    const S3<T>& c = shift_shift;
    const M3<T>& o = turn_shift;
    // B + [arm] C, column by column
    const M3<T> b{o.x + cross(arm, V3<T>{c.xx, c.xy, c.xz}), o.y + cross(arm, V3<T>{c.xy, c.yy, c.yz}),
                  o.z + cross(arm, V3<T>{c.xz, c.yz, c.zz})};
    // A - B [arm] + [arm] b'
    const V3<T> ox = o.z * arm.y - o.y * arm.z, oy = o.x * arm.z - o.z * arm.x, oz = o.y * arm.x - o.x * arm.y;
    const V3<T> bx = cross(arm, V3<T>{b.x.x, b.y.x, b.z.x}), by = cross(arm, V3<T>{b.x.y, b.y.y, b.z.y}),
                bz = cross(arm, V3<T>{b.x.z, b.y.z, b.z.z});
    to.turn_turn += {turn_turn.xx + ox.x + bx.x, turn_turn.xy + oy.x + by.x, turn_turn.xz + oz.x + bz.x,
                     turn_turn.yy + oy.y + by.y, turn_turn.yz + oz.y + bz.y, turn_turn.zz + oz.z + bz.z};
    to.turn_shift += b;
    to.shift_shift += c;
    to.slope += {slope.turn + cross(arm, slope.shift), slope.shift};
    if (!any(newton > T(0.0))) return;
    to.pull += pull;
    to.moment.x += moment.x + arm * pull.x;
    to.moment.y += moment.y + arm * pull.y;
    to.moment.z += moment.z + arm * pull.z;
  }
};

// The same for one alone, in whole columns: three registers a block. turn_shift is kept the other way round.
template <>
struct Load<double> {
  using V = V3<double>;
  M3<double> turn_turn, shift_turn, shift_shift;
  Wrench<double> slope;
  V pull;
  M3<double> moment;

  HWY_INLINE void clear() {
    const V none{0.0, 0.0, 0.0};
    turn_turn = shift_turn = shift_shift = moment = {none, none, none};
    slope.clear();
    pull = none;
  }

  HWY_INLINE void add_point(const V& arm, const V& force, double weight) {
    const V wa = arm * weight, x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0};
    const double square = dot(wa, arm);
    turn_turn.x += x * square - arm * wa.x;
    turn_turn.y += y * square - arm * wa.y;
    turn_turn.z += z * square - arm * wa.z;
    shift_turn.x += cross(x, wa);
    shift_turn.y += cross(y, wa);
    shift_turn.z += cross(z, wa);
    shift_shift.x += x * weight;
    shift_shift.y += y * weight;
    shift_shift.z += z * weight;
    slope += {cross(arm, force), force};
    add_second_order(arm, force);
  }

  HWY_INLINE void add_row(const Wrench<double>& row, double force, double weight) {
    add_outer(turn_turn, row.turn * weight, row.turn);
    add_outer(shift_turn, row.shift * weight, row.turn);
    add_outer(shift_shift, row.shift * weight, row.shift);
    slope += row * force;
  }

  HWY_INLINE void add_second_order(const V& arm, const V& force) {
    pull += force;
    add_outer(moment, arm, force);
  }

  // Of an error in the direction of an axis: `way` is the slope for its tip.
  HWY_INLINE void add_second_order_tip(const V& tip, const V& way) { add_outer(moment, tip, way); }
  // Of an error in turn: two turns one after the other make a third half of the way across; less `excess` times
  // torque's square about all that is across it.
  HWY_INLINE void add_second_order_torque(const V& torque, double excess) {
    const V half = torque * 0.5, more = torque * excess;
    moment.x += V{0.0, -half.z, half.y} + torque * more.x;
    moment.y += V{half.z, 0.0, -half.x} + torque * more.y;
    moment.z += V{-half.y, half.x, 0.0} + torque * more.z;
  }

  HWY_INLINE double trace() const { return moment.x.x + moment.y.y + moment.z.z; }

  HWY_INLINE void times_turn(const V& axis, double newton, V& turn, V& shift) const {
    turn = turn_turn * axis;
    if (newton != 0.0) turn += (moment * axis - axis * trace()) * newton;
    shift = shift_turn * axis;
  }
  HWY_INLINE void times_shift(const V& axis, double newton, V& turn, V& shift) const {
    turn = shift_turn.turned_back(axis) + cross(axis, pull) * newton;
    shift = shift_shift * axis;
  }

  HWY_INLINE void take_out(const V& u, const V& w, double inverse, double share) {
    const V us = u * -inverse, ws = w * -inverse;
    add_outer(turn_turn, us, u);
    add_outer(shift_turn, ws, u);
    add_outer(shift_shift, ws, w);
    slope.turn -= u * share;
    slope.shift -= w * share;
  }

  HWY_INLINE void hand_down(const V& arm, double newton, Load& to) const {
    const M3<double>&c = shift_shift, &d = shift_turn;
    // D - C [arm]
    const M3<double> handed{d.x + c.z * arm.y - c.y * arm.z, d.y + c.x * arm.z - c.z * arm.x,
                            d.z + c.y * arm.x - c.x * arm.y};
    // A + [arm] D' + ([arm] D)'
    const V ex = cross(arm, d.x), ey = cross(arm, d.y), ez = cross(arm, d.z);
    to.turn_turn.x += turn_turn.x + cross(arm, handed.x) + V{ex.x, ey.x, ez.x};
    to.turn_turn.y += turn_turn.y + cross(arm, handed.y) + V{ex.y, ey.y, ez.y};
    to.turn_turn.z += turn_turn.z + cross(arm, handed.z) + V{ex.z, ey.z, ez.z};
    to.shift_turn += handed;
    to.shift_shift += c;
    to.slope += {slope.turn + cross(arm, slope.shift), slope.shift};
    if (newton == 0.0) return;
    to.pull += pull;
    to.moment.x += moment.x + arm * pull.x;
    to.moment.y += moment.y + arm * pull.y;
    to.moment.z += moment.z + arm * pull.z;
  }

 private:
  HWY_INLINE static void add_outer(M3<double>& to, const V& a, const V& b) {
    to.x += a * b.x;
    to.y += a * b.y;
    to.z += a * b.z;
  }
};

// Entry k of row i of a load's block that couples turn i with shift k.
template <class T>
HWY_INLINE M3<T> turn_shift_of(const Load<T>& load) {
  return load.turn_shift;
}
HWY_INLINE M3<double> turn_shift_of(const Load<double>& load) {
  const M3<double>& d = load.shift_turn;
  return {{d.x.x, d.y.x, d.z.x}, {d.x.y, d.y.y, d.z.y}, {d.x.z, d.y.z, d.z.z}};
}
template <class T>
HWY_INLINE S3<T> upper(const S3<T>& s) {
  return s;
}
HWY_INLINE S3<double> upper(const M3<double>& m) {
  return {m.x.x, m.y.x, m.z.x, m.y.y, m.z.y, m.z.z};
}

// The six degrees of freedom of a floating root, solved at once by L D L', the shift first: its pivots are sums of
// weights.
template <class T>
struct RootFactor {
  T l[6][6], inverse[6];

  // Damping: of the shift (3) and the turn (3). Returns how many pivots are not above 0.
  HWY_INLINE T factor(const Load<T>& load, const T (&damping)[6], const T& newton) {
    const M3<T>& m = load.moment;
    const T trace = load.trace(), half = newton * T(0.5);
    T a[6][6];
    const S3<T> r = upper(load.turn_turn), c = upper(load.shift_shift);
    const M3<T> b = turn_shift_of(load);
    a[0][0] = r.xx + newton * (m.x.x - trace) + damping[3];
    a[1][0] = r.xy + half * (m.x.y + m.y.x);
    a[1][1] = r.yy + newton * (m.y.y - trace) + damping[4];
    a[2][0] = r.xz + half * (m.x.z + m.z.x);
    a[2][1] = r.yz + half * (m.y.z + m.z.y);
    a[2][2] = r.zz + newton * (m.z.z - trace) + damping[5];
    a[3][0] = b.x.x, a[3][1] = b.x.y, a[3][2] = b.x.z;
    a[4][0] = b.y.x, a[4][1] = b.y.y, a[4][2] = b.y.z;
    a[5][0] = b.z.x, a[5][1] = b.z.y, a[5][2] = b.z.z;
    a[3][3] = c.xx + damping[0];
    a[4][3] = c.xy, a[4][4] = c.yy + damping[1];
    a[5][3] = c.xz, a[5][4] = c.yz, a[5][5] = c.zz + damping[2];
    T concave(0.0);
    POSED_UNROLL
    for (int k = 5; k >= 0; --k) {
      concave = concave + select(a[k][k] > T(0.0), T(0.0), T(1.0));
      inverse[k] = T(1.0) / a[k][k];
      POSED_UNROLL
      for (int i = 0; i < k; ++i) l[k][i] = a[k][i] * inverse[k];
      POSED_UNROLL
      for (int i = 0; i < k; ++i) {
        POSED_UNROLL
        for (int j = 0; j <= i; ++j) a[i][j] = a[i][j] - a[k][i] * l[k][j];
      }
    }
    return concave;
  }

  // The motion that undoes `slope`; adds to `gain` what the quadratic loses by it.
  HWY_INLINE Wrench<T> solve(const Wrench<T>& slope, T& gain) const {
    T y[6] = {-slope.turn.x, -slope.turn.y, -slope.turn.z, -slope.shift.x, -slope.shift.y, -slope.shift.z};
    POSED_UNROLL
    for (int k = 5; k >= 0; --k) {
      gain = gain + y[k] * y[k] * inverse[k];
      POSED_UNROLL
      for (int i = 0; i < k; ++i) y[i] = y[i] - l[k][i] * y[k];
      y[k] = y[k] * inverse[k];
    }
    POSED_UNROLL
    for (int k = 1; k < 6; ++k) {
      POSED_UNROLL
      for (int i = 0; i < k; ++i) y[k] = y[k] - l[k][i] * y[i];
    }
    return {{y[0], y[1], y[2]}, {y[3], y[4], y[5]}};
  }
};

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
