#include "server/solver/springs/sweeps.h"

#include <cstddef>
#include <cstring>

#include "server/solver/springs/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/solver/springs/sweeps.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include "server/solver/springs/vectors-inl.h"

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

using Wide = V3<double>::Wide;

HWY_INLINE Wide load(const double* v) {
  Wide out;
  std::memcpy(&out, v, sizeof out);
  return out;
}
HWY_INLINE Wide all(double v) {
  return Wide{v, v, v, v};
}

// Of quaternions x y z w.
HWY_INLINE Wide times(const Wide& a, const Wide& b) {
  return all(a[3]) * b + all(a[0]) * (__builtin_shufflevector(b, b, 3, 2, 1, 0) * Wide{1, -1, 1, -1}) +
         all(a[1]) * (__builtin_shufflevector(b, b, 2, 3, 0, 1) * Wide{1, 1, -1, -1}) +
         all(a[2]) * (__builtin_shufflevector(b, b, 1, 0, 3, 2) * Wide{-1, 1, 1, -1});
}
HWY_INLINE V3<double> rotated(const Wide& quat, const V3<double>& v) {
  const V3<double> u(quat), c = cross(u, v);
  return v + c * (2.0 * quat[3]) + cross(u, c) * 2.0;
}

void place_segments_here(const BodyTree& tree, const double* q, Transform* out) {
  static_assert(offsetof(Quat, x) == 0 && offsetof(Quat, w) == 3 * sizeof(double));
  for (int i = 0; i < tree.size(); ++i) {
    const Joint& joint = tree.joint(i);
    const double* share = q + tree.q_at(i);
    V3<double> position(joint.parent_from_joint.position);
    Wide rotation = load(&joint.parent_from_joint.rotation.x);
    if (joint.type == JointType::free) {
      position = {share[0], share[1], share[2]};
      rotation = load(share + 3);
    } else {
      if (i > 0) {
        const Transform& parent = out[tree.parent(i)];
        const Wide turn = load(&parent.rotation.x);
        position = V3<double>(parent.position) + rotated(turn, position);
        const bool straight = rotation[3] == 1.0 && rotation[0] == 0.0 && rotation[1] == 0.0 && rotation[2] == 0.0;
        rotation = straight ? turn : times(turn, rotation);
      }
      if (joint.type == JointType::ball || joint.type == JointType::universal) {
        rotation = times(rotation, load(share));
      } else if (joint.type == JointType::hinge) {
        const Quat turn = quat_about(joint.axes[0], share[0]);
        rotation = times(rotation, load(&turn.x));
      } else if (joint.type == JointType::prismatic) {
        position += rotated(rotation, V3<double>(joint.axes[0])) * share[0];
      }
    }
    out[i].position = {position.x, position.y, position.z};
    std::memcpy(&out[i].rotation.x, &rotation, sizeof rotation);
  }
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posed::springs {

HWY_EXPORT(arc_tangents_here);
HWY_EXPORT(half_sines_here);
HWY_EXPORT(place_segments_here);

void arc_tangents(const double* y, const double* x, std::size_t n, double* angle) {
  HWY_DYNAMIC_DISPATCH(arc_tangents_here)(y, x, n, angle);
}
void half_sines(const double* angle, std::size_t n, double* sine, double* cosine) {
  HWY_DYNAMIC_DISPATCH(half_sines_here)(angle, n, sine, cosine);
}
void place_segments(const BodyTree& tree, std::span<const double> q, std::span<Transform> world_from_segment) {
  HWY_DYNAMIC_DISPATCH(place_segments_here)(tree, q.data(), world_from_segment.data());
}

}  // namespace posed::springs
#endif
