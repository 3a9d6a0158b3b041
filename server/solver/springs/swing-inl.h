// Where a limb points, and the edge of where it may (Korein 1985; common/figure.h: Swing). Joint's frame.
#if defined(POSED_SPRINGS_SWING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_SPRINGS_SWING_INL_H_
#undef POSED_SPRINGS_SWING_INL_H_
#else
#define POSED_SPRINGS_SWING_INL_H_
#endif

#include "server/solver/springs/plan.h"
#include "server/solver/springs/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

inline constexpr double kOnEdge = 1e-9;

// The turn by the angle of this sine and cosine.
template <class T>
HWY_INLINE M3<T> about(const V3<T>& axis, const T& s, const T& c) {
  const T k = T(1.0) - c;
  const V3<T> ka = axis * k, sa = axis * s;
  return {{c + ka.x * axis.x, ka.x * axis.y + sa.z, ka.x * axis.z - sa.y},
          {ka.y * axis.x - sa.z, c + ka.y * axis.y, ka.y * axis.z + sa.x},
          {ka.z * axis.x + sa.y, ka.z * axis.y - sa.x, c + ka.z * axis.z}};
}

// A direction as seen from the centre of an ellipse: u of common/figure.h, and how far it is out.
template <class T>
struct OnEllipse {
  V3<T> radial;    // unit, at the centre: the way to the direction
  T angle, ratio;  // ratio: angle / sin(angle)
  T across[2];     // u over the radii
  T level;         // 1: on the edge

  HWY_INLINE OnEllipse(const Link& link, const V3<T>& d) {
    const Swing& swing = link.swing;
    const V3<T> c(swing.center), t0(link.swing_axes[0]), t1(link.swing_axes[1]);
    const T cosine = dot(c, d);
    const V3<T> side = d - c * cosine;
    const T sine = root(dot(side, side));
    const T least_sine(1e-12);
    // Straight ahead and straight behind have no side.
    const T ahead_or_behind = select(cosine < T(0.0), T(M_PI), T(0.0));
    angle = select(sine > least_sine, T(2.0) * arc_tangent(sine / most(T(1.0) + cosine, T(1e-300))), ahead_or_behind);
    radial = select(sine > least_sine, side * (T(1.0) / most(sine, least_sine)), t0);
    ratio = select(sine > T(1e-6), angle / most(sine, least_sine), T(1.0));
    across[0] = dot(radial, t0) * angle * T(1.0 / swing.radii[0]);
    across[1] = dot(radial, t1) * angle * T(1.0 / swing.radii[1]);
    level = across[0] * across[0] + across[1] * across[1];
    first_ = t0, second_ = t1;
  }

  // The unit tangent at d that points straight out. `room`: how far it is to the edge that way, rad (nearly).
  HWY_INLINE V3<T> outward(const Swing& swing, const V3<T>& d, T& room) const {
    const V3<T> slope =
        first_ * (across[0] * T(1.0 / swing.radii[0])) + second_ * (across[1] * T(1.0 / swing.radii[1]));
    const V3<T> c(swing.center), tangent = cross(c, radial);
    const V3<T> radial_there = cross(tangent, d);  // the same way, at d
    const V3<T> out = radial_there * dot(slope, radial) + tangent * (dot(slope, tangent) * ratio);
    const T length = root(dot(out, out)), middle = root(level);
    room = select(length > T(1e-12), (T(1.0) - middle) * middle / most(length, T(1e-300)), T(1.0));
    return select(length > T(1e-12), out * (T(1.0) / most(length, T(1e-300))), radial_there);
  }

 private:
  V3<T> first_, second_;
};

template <class T>
struct Swinging {
  V3<T> direction;             // of the limb
  M3<T> rotation;              // the shortest arc from its rest
  V3<T> out, along;            // unit tangents: away from where it may point, and along the edge
  V3<T> turn_out, turn_along;  // turns that move it so, and keep its twist
  // What a step x out and y along adds to the turn in second order, beyond one step after the other:
  // (bend_out x^2 + 2 bend_both x y + bend_along y^2) / 2.
  V3<T> bend_out, bend_both, bend_along;
  T on_edge;                        // 1: a step out is barred
  T room;                           // how far a step out may go
  T back, ahead;                    // on the edge: how far a step along may go, to the corners
  T round_back[2], round_ahead[2];  // at a corner: the way on along the next edge, its parts out and along
  T curvature;                      // of the edge: a step s along is one of -curvature s^2 / 2 out

  // The limb's direction and rotation; `see` has all the rest.
  HWY_INLINE void point(const Link& link, const V3<T>& d) {
    const T zero(0.0), one(1.0);
    direction = d;
    const V3<T> p(link.limb);
    const V3<T> v = cross(p, d);
    const T c = dot(p, d);
    // 1 + c, without its loss of digits where the limb points backwards
    inverse_turned_ = one / select(c < zero, most(dot(v, v), T(1e-30)) / (one - c), one + c);
    const V3<T> q = v * inverse_turned_;
    rotation = {{c + q.x * v.x, q.x * v.y + v.z, q.x * v.z - v.y},
                {q.y * v.x - v.z, c + q.y * v.y, q.y * v.z + v.x},
                {q.z * v.x + v.y, q.z * v.y - v.x, c + q.z * v.z}};
    // Straight backwards any arc is shortest: it turns about the same axis as shortest_arc.
    const Mask<T> backwards = c < T(-1.0 + 1e-14);
    if (!any(backwards)) return;
    const V3<T> n(link.side), n2 = n * T(2.0);
    rotation = {select(backwards, n2 * n.x - V3<T>(kX), rotation.x),
                select(backwards, n2 * n.y - V3<T>(kY), rotation.y),
                select(backwards, n2 * n.z - V3<T>(kZ), rotation.z)};
  }

  // The edge of where it may point, and how its steps turn it.
  HWY_INLINE void see(const Link& link) {
    const T zero(0.0), one(1.0);
    const V3<T> d = direction, p(link.limb);
    on_edge = curvature = zero;
    back = T(-kFarAhead), room = ahead = T(kFarAhead);
    round_back[0] = round_back[1] = round_ahead[0] = round_ahead[1] = zero;
    out = V3<T>(link.side);
    if (link.swings_freely) {
    } else if (link.swing.kind == Swing::Kind::ellipse) {
      const OnEllipse<T> on(link, d);
      out = on.outward(link.swing, d, room);
      on_edge = select(on.level >= T(1.0 - kOnEdge), one, zero);
    } else {
      T depth(1e300);
      for_edges(link.swing, [&](const V3<T>& inward) {
        const T inside = dot(inward, d);
        out = select(inside < depth, -inward, out);
        depth = least(depth, inside);
      });
      on_edge = select(depth <= T(kOnEdge), one, zero);
      const T sideways = dot(out, d);
      room = depth / root(most(one - sideways * sideways, T(1e-12)));
    }
    room = most(room, zero);
    out = out - d * dot(out, d);
    out = out * (one / most(root(dot(out, out)), T(1e-9)));
    along = cross(d, out);
    if (any(on_edge > zero)) follow_edge(link);
    const T po = dot(p, out), pa = dot(p, along), w = inverse_turned_, half(0.5);
    const T a = pa * w, b = po * w;
    turn_out = along - d * a;
    turn_along = d * b - out;
    bend_out = d * (a * b) - out * a;
    bend_along = along * b - d * (a * b);
    bend_both = (out * b - along * a + d * (a * a - b * b) - (d + out * b + along * a)) * half;
  }

  // A step out (0), along (1) or in twist (2), no farther than to the edge or its corners. From a corner it may go on.
  HWY_INLINE T within(int dof, const T& step) const {
    const T near(kOnEdge), far(kFarAhead);
    if (dof == 0) return least(step, room);
    if (dof == 2) return step;
    return most(least(step, select(ahead > near, ahead, far)), select(back < -near, back, -far));
  }

  // At a corner, and pressed against both of its edges: neither along this one nor along the next is it downhill.
  HWY_INLINE Mask<T> in_corner(const T& slope_out, const T& slope_along) const {
    const T zero(0.0), near(kOnEdge);
    const T on = slope_out * round_ahead[0] + slope_along * round_ahead[1];
    const T back_on = slope_out * round_back[0] + slope_along * round_back[1];
    return ((ahead <= near) & (slope_along < zero) & (on >= zero)) |
           ((back >= -near) & (slope_along > zero) & (back_on >= zero));
  }

 private:
  static constexpr double kFarAhead = 1e3;
  static constexpr double kLittle = 1e-4;  // rad

  template <class F>
  static HWY_INLINE void for_edges(const Swing& swing, F f) {
    const auto& corners = swing.corners;
    for (std::size_t k = 0; k < corners.size(); ++k)
      f(V3<T>(glm::normalize(glm::cross(corners[k], corners[(k + 1) % corners.size()]))));
  }

  // To the corners, which a step along meets exactly; of an ellipse how it bends.
  HWY_INLINE void follow_edge(const Link& link) {
    const Swing& swing = link.swing;
    const T zero(0.0), one(1.0), tiny(1e-12);
    if (swing.kind == Swing::Kind::polygon) {
      for_edges(swing, [&](const V3<T>& inward) {
        const T inside = most(dot(inward, direction), zero), change = dot(inward, along);
        const T left = inside / most(magnitude(change), tiny);
        const Mask<T> nearer = (change < -tiny) & (left < ahead), nearer_back = (change > tiny) & (-left > back);
        ahead = select(nearer, left, ahead);
        back = select(nearer_back, -left, back);
        const V3<T> next = cross(inward, direction);
        const T outward = dot(next, out), onward = dot(next, along);
        round_ahead[0] = select(nearer, outward, round_ahead[0]),
        round_ahead[1] = select(nearer, onward, round_ahead[1]);
        round_back[0] = select(nearer_back, -outward, round_back[0]);
        round_back[1] = select(nearer_back, -onward, round_back[1]);
      });
      return;
    }
    const auto out_at = [&](const T& step) {
      V3<T> there = direction + along * step;
      there = there * (one / root(dot(there, there)));
      T unused;
      return OnEllipse<T>(link, there).outward(swing, there, unused);
    };
    const T little(kLittle);
    curvature = dot(along, out_at(little) - out_at(-little)) * T(0.5 / kLittle);
  }

  T inverse_turned_;  // 1 / (1 + cosine of the swing)
};

// Brings a direction back to where the limb may point. `follow`: on to the edge of an ellipse from inside as well.
template <class T>
HWY_INLINE V3<T> kept_inside(const Link& link, V3<T> d, const Mask<T>& follow = T(0.0) > T(0.0)) {
  const T one(1.0);
  d = d * (one / root(dot(d, d)));
  if (link.swings_freely) return d;
  if (link.swing.kind == Swing::Kind::ellipse) {
    if (!any((dot(V3<T>(link.swing.center), d) <= T(link.surely_inside)) | follow)) return d;
    const OnEllipse<T> on(link, d);
    const Mask<T> to_edge = (on.level > one) | (follow & (on.level > T(0.5)));
    if (!any(to_edge)) return d;
    const T angle = on.angle / root(select(to_edge, on.level, one));
    T s, c;
    sine_and_cosine(angle, s, c);
    return select(to_edge, V3<T>(link.swing.center) * c + on.radial * s, d);
  }
  // The nearest place of the edge: on one of the great arcs, or else a corner.
  const auto& corners = link.swing.corners;
  const T zero(0.0);
  V3<T> best = d;
  T nearest(-2.0), depth(1.0);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 &first = corners[k], &second = corners[(k + 1) % corners.size()];
    const Vec3 normal = glm::normalize(glm::cross(first, second));
    const V3<T> inward(normal);
    const T inside = dot(inward, d);
    depth = least(depth, inside);
    const V3<T> foot = d - inward * inside;
    const V3<T> on = foot * (one / root(most(dot(foot, foot), T(1e-30))));
    const Mask<T> between =
        (dot(V3<T>(glm::cross(normal, first)), on) >= zero) & (dot(V3<T>(glm::cross(second, normal)), on) >= zero);
    const V3<T> here = select(between, on, V3<T>(first));
    const T near = dot(here, d);
    best = select(near > nearest, here, best);
    nearest = most(near, nearest);
  }
  return select(depth < zero, best, d);
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
