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

  HWY_INLINE OnEllipse(const Swing& swing, const V3<T>& d) {
    const V3<T> c(swing.center);
    const V3<T> t0(perpendicular(swing.center, std::abs(swing.center.x) > 0.999999 ? kY : kX));
    const V3<T> t1 = cross(c, t0);
    const T cosine = dot(c, d);
    const V3<T> side = d - c * cosine;
    const T sine = root(dot(side, side));
    const T least_sine(1e-12);
    angle = T(2.0) * arc_tangent(sine / most(T(1.0) + cosine, least_sine));
    radial = select(sine > least_sine, side * (T(1.0) / most(sine, least_sine)), t0);
    ratio = select(sine > T(1e-6), angle / most(sine, least_sine), T(1.0));
    across[0] = dot(radial, t0) * angle * T(1.0 / swing.radii[0]);
    across[1] = dot(radial, t1) * angle * T(1.0 / swing.radii[1]);
    level = across[0] * across[0] + across[1] * across[1];
    first_ = t0, second_ = t1;
  }

  // The unit tangent at d that points straight out.
  HWY_INLINE V3<T> outward(const Swing& swing, const V3<T>& d) const {
    const V3<T> slope =
        first_ * (across[0] * T(1.0 / swing.radii[0])) + second_ * (across[1] * T(1.0 / swing.radii[1]));
    const V3<T> c(swing.center), tangent = cross(c, radial);
    const V3<T> radial_there = cross(tangent, d);  // the same way, at d
    const V3<T> out = radial_there * dot(slope, radial) + tangent * (dot(slope, tangent) * ratio);
    const T length = root(dot(out, out));
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
  T on_edge;                   // 1: a step out is barred
  T corner;                    // 1 and -1: a step along, or back along, is barred

  HWY_INLINE void see(const Link& link, const V3<T>& d) {
    const T zero(0.0), one(1.0);
    direction = d;
    const V3<T> p(link.limb);
    const V3<T> v = cross(p, d);
    const T c = dot(p, d);
    // 1 + c, without its loss of digits where the limb points backwards
    const T near_turned = select(c < zero, most(dot(v, v), T(1e-30)) / (one - c), one + c);
    const V3<T> q = v * (one / near_turned);
    rotation = {{c + q.x * v.x, q.x * v.y + v.z, q.x * v.z - v.y},
                {q.y * v.x - v.z, c + q.y * v.y, q.y * v.z + v.x},
                {q.z * v.x + v.y, q.z * v.y - v.x, c + q.z * v.z}};
    on_edge = corner = zero;
    out = V3<T>(perpendicular(link.limb, kX));
    out = out - d * dot(out, d);
    out = out * (one / most(root(dot(out, out)), T(1e-9)));
    V3<T> second{zero, zero, zero};
    T depth(1e300), second_depth(1e300);
    if (link.swings_freely) {
    } else if (link.swing.kind == Swing::Kind::ellipse) {
      const OnEllipse<T> on(link.swing, d);
      out = on.outward(link.swing, d);
      on_edge = select(on.level >= T(1.0 - kOnEdge), one, zero);
    } else {
      const auto& corners = link.swing.corners;
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 edge = glm::normalize(glm::cross(corners[k], corners[(k + 1) % corners.size()]));
        const V3<T> inward(edge);
        const T inside = dot(inward, d);
        const Mask<T> deepest = inside < depth;
        const Mask<T> next = inside < second_depth;
        second = select(deepest, -out, select(next, inward, second));
        second_depth = select(deepest, depth, select(next, inside, second_depth));
        out = select(deepest, -inward, out);
        depth = select(deepest, inside, depth);
      }
      on_edge = select(depth <= T(kOnEdge), one, zero);
      out = out - d * dot(out, d);
      out = out * (one / most(root(dot(out, out)), T(1e-9)));
    }
    along = cross(d, out);
    corner = select(second_depth <= T(kOnEdge), select(dot(second, along) < zero, one, -one), zero);
    turn_out = along - d * (dot(p, along) * (one / near_turned));
    turn_along = -out + d * (dot(p, out) * (one / near_turned));
  }
};

// Brings a direction back to where the limb may point.
template <class T>
HWY_INLINE V3<T> kept_inside(const Link& link, V3<T> d) {
  const T one(1.0);
  d = d * (one / root(dot(d, d)));
  if (link.swings_freely) return d;
  if (link.swing.kind == Swing::Kind::ellipse) {
    const OnEllipse<T> on(link.swing, d);
    const T angle = on.angle / root(most(on.level, one));
    T s, c;
    sine_and_cosine(angle, s, c);
    return select(on.level > one, V3<T>(link.swing.center) * c + on.radial * s, d);
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
