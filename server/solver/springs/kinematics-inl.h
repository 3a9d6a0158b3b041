// Forward kinematics of a plan: where each link is, and the world axis of each degree of freedom.
#if defined(POSED_SPRINGS_KINEMATICS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_SPRINGS_KINEMATICS_INL_H_
#undef POSED_SPRINGS_KINEMATICS_INL_H_
#else
#define POSED_SPRINGS_KINEMATICS_INL_H_
#endif

#include "server/solver/springs/memory-inl.h"
#include "server/solver/springs/plan.h"
#include "server/solver/springs/swing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

// The values of State, lane by lane.
template <class T>
struct Steps {
  Memory<T> turns, more;
  void resize(const Plan& plan) {
    turns.resize(plan.dofs.size() + kLanes);  // sines() writes whole vectors
    more.resize(plan.more);
  }
};

template <class T>
struct Placed {
  M3<T> rotation;  // world_from_segment
  V3<T> centre;    // of its joint
};

template <class T>
class Kinematics {
 public:
  void resize(const Plan& plan) {
    placed_.resize(plan.links.size());
    swings_.resize(plan.links.size());
    frames_.resize(plan.links.size());
    axes_.resize(plan.dofs.size());
    sine_.resize(plan.dofs.size() + kLanes);
    cosine_.resize(plan.dofs.size() + kLanes);
  }

  void place(const Plan& plan, const Steps<T>& at) {
    sines(at.turns.data(), plan.dofs.size(), sine_.data(), cosine_.data());
    for (std::size_t i = 0; i < plan.links.size(); ++i) place_link(plan, i, at);
  }

  // Where limbs may go from here. Their axes, and what swinging() has, are those of the last call.
  void see_edges(const Plan& plan) {
    for (std::size_t i = 0; i < plan.links.size(); ++i) {
      const Link& link = plan.links[i];
      if (link.kind != LinkKind::limb) continue;
      Swinging<T>& swinging = swings_[i];
      swinging.see(link);
      const M3<T>& r = frames_[i];
      const auto first = static_cast<std::size_t>(link.dof);
      axes_[first] = r * swinging.turn_out, axes_[first + 1] = r * swinging.turn_along;
      axes_[first + 2] = r * swinging.direction;
      swinging.bend_out = r * swinging.bend_out, swinging.bend_both = r * swinging.bend_both;
      swinging.bend_along = r * swinging.bend_along;
    }
  }

  const Placed<T>& placed(int link) const { return placed_[static_cast<std::size_t>(link)]; }
  const V3<T>& axis(std::size_t dof) const { return axes_[dof]; }
  const Swinging<T>& swinging(std::size_t link) const { return swings_[link]; }  // of limbs

 private:
  HWY_INLINE void place_link(const Plan& plan, std::size_t i, const Steps<T>& at) {
    const Link& link = plan.links[i];
    Placed<T>& out = placed_[i];
    const T* more = at.more.data() + link.more;
    if (link.kind == LinkKind::floating) {
      out.centre = {more[0], more[1], more[2]};
      out.rotation = matrix<T>(more[3], more[4], more[5], more[6]);
      return;
    }
    M3<T> r;
    if (link.parent >= 0) {
      const Placed<T>& parent = placed(link.parent);
      out.centre = parent.centre + parent.rotation * V3<T>(link.offset);
      r = link.rotated ? parent.rotation * matrix<T>(link.rotation) : parent.rotation;
    } else {
      out.centre = V3<T>(link.offset);
      r = matrix<T>(link.rotation);
    }
    const auto first = static_cast<std::size_t>(link.dof);
    if (link.kind == LinkKind::ball) {
      axes_[first] = r.x, axes_[first + 1] = r.y, axes_[first + 2] = r.z;
      r = r * matrix<T>(more[0], more[1], more[2], more[3]);
    } else if (link.kind == LinkKind::limb) {
      Swinging<T>& swinging = swings_[i];
      swinging.point(link, {more[0], more[1], more[2]});
      frames_[i] = r;
      r = r * (swinging.rotation * about(V3<T>(link.limb), sine_[first + 2], cosine_[first + 2]));
    } else {
      for (std::size_t j = first; j < first + static_cast<std::size_t>(link.dofs); ++j)
        turn(plan, j, at, r, out.centre);
    }
    out.rotation = r;
  }

  HWY_INLINE static void roll(V3<T>& first, V3<T>& second, const T& s, const T& c) {
    const V3<T> turned = first * c + second * s;
    second = second * c - first * s;
    first = turned;
  }

  HWY_INLINE void turn(const Plan& plan, std::size_t j, const Steps<T>& at, M3<T>& r, V3<T>& centre) {
    const Dof& dof = plan.dofs[j];
    const T sign(dof.sign), c = cosine_[j], s = sine_[j] * sign;
    switch (dof.kind) {
      case DofKind::about_x:
        axes_[j] = r.x * sign;
        return roll(r.y, r.z, s, c);
      case DofKind::about_y:
        axes_[j] = r.y * sign;
        return roll(r.z, r.x, s, c);
      case DofKind::about_z:
        axes_[j] = r.z * sign;
        return roll(r.x, r.y, s, c);
      case DofKind::about_axis:
        r = r * matrix<T>(dof.z_to_axis);
        axes_[j] = r.z;
        roll(r.x, r.y, s, c);
        r = r * matrix<T>(glm::conjugate(dof.z_to_axis));
        return;
      case DofKind::along_axis:
        axes_[j] = r * V3<T>(dof.axis);
        centre += axes_[j] * at.turns[j];
        return;
      case DofKind::of_ball:
      case DofKind::of_root:
        return;
    }
  }

  Memory<Placed<T>> placed_;
  Memory<Swinging<T>> swings_;
  Memory<M3<T>> frames_;  // of limbs: world_from_joint, before their own turn
  Memory<V3<T>> axes_;
  Memory<T> sine_, cosine_;
};

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
