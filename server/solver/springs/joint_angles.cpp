#include "server/solver/springs/joint_angles.h"

#include <algorithm>
#include <cmath>

#include "server/solver/ball_angles.h"
#include "server/solver/springs/sweeps.h"
#include "server/solver/springs/swing.h"

namespace posed::springs {
namespace {

constexpr int kHoldTries = 8;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

Quat swing_of(const Link& link, const Vec3& direction) {
  return shortest_arc(link.limb, direction, link.side);
}

std::array<AngleRange, 3> ranges_of(const Dof* dofs) {
  return {{{dofs[0].min, dofs[0].max}, {dofs[1].min, dofs[1].max}, {dofs[2].min, dofs[2].max}}};
}

bool inside(const Dof* dofs, const double* angles) {
  return angles[0] >= dofs[0].min && angles[0] <= dofs[0].max && angles[1] >= dofs[1].min && angles[1] <= dofs[1].max &&
         angles[2] >= dofs[2].min && angles[2] <= dofs[2].max;
}

// Tangent of the turn about `axis` that carries `from` to `to`, as far as it can.
void tangent_about(const Vec3& axis, const Vec3& from, const Vec3& to, double& y, double& x) {
  y = glm::dot(axis, glm::cross(from, to));
  x = glm::dot(from, to) - glm::dot(axis, from) * glm::dot(axis, to);
}

void read_limb(const Link& link, const Quat& rotation, double* turns, double* more) {
  const Vec3 d = rotation * link.limb;
  const Quat twist = glm::conjugate(swing_of(link, d)) * rotation;
  double turn = 2.0 * std::atan2(glm::dot(Vec3(twist.x, twist.y, twist.z), link.limb), twist.w);
  if (turn > M_PI) turn -= 2.0 * M_PI;
  if (turn <= -M_PI) turn += 2.0 * M_PI;
  more[0] = d.x, more[1] = d.y, more[2] = d.z, more[3] = 0.0;
  turns[0] = turns[1] = 0.0, turns[2] = turn;
}

}  // namespace

double home(const Dof& dof, double turn) {
  const bool turns = dof.kind != DofKind::along_axis && dof.kind != DofKind::of_root;
  return turns ? near_range(turn, {dof.min, dof.max}) : turn;
}

bool hold_back(const Link& link, const State& from, double most, State& state) {
  if (link.kind != LinkKind::ball && link.kind != LinkKind::limb) return false;
  const double* before = from.more.data() + link.more;
  double* now = state.more.data() + link.more;
  const auto turned = [](const Quat& a, const Quat& b) {
    const Quat off = glm::conjugate(a) * b;
    return 2.0 * std::atan2(glm::length(Vec3(off.x, off.y, off.z)), std::abs(off.w));
  };
  const auto quat = [](const double* v) { return glm::normalize(quat_from_xyzw(std::span<const double>(v, 4))); };
  if (link.kind == LinkKind::ball) {
    const Quat a = quat(before), b = quat(now);
    const double angle = turned(a, b);
    if (angle <= most) return false;
    const auto back = xyzw(glm::slerp(a, same_sign(a, b), most / angle));
    std::copy(back.begin(), back.end(), now);
    return true;
  }
  const Vec3 d0(before[0], before[1], before[2]), d1(now[0], now[1], now[2]);
  const double twist0 = from.turns[at(link.dof + 2)], twist1 = state.turns[at(link.dof + 2)];
  const Quat a = swing_of(link, d0) * quat_about(link.limb, twist0), arc = shortest_arc(d0, d1, perpendicular(d0, kX));
  double share = 1.0;
  for (int tries = 0; tries < kHoldTries; ++tries) {
    const Vec3 d = inside_swing(link, glm::normalize(glm::slerp(quat_identity(), arc, share) * d0));
    const double twist = twist0 + share * (twist1 - twist0);
    const double angle = turned(a, swing_of(link, d) * quat_about(link.limb, twist));
    if (tries == 0 && angle <= most) return false;
    now[0] = d.x, now[1] = d.y, now[2] = d.z;
    state.turns[at(link.dof + 2)] = twist;
    if (angle <= most) return true;
    share *= 0.99 * most / angle;
  }
  now[0] = d0.x, now[1] = d0.y, now[2] = d0.z;
  state.turns[at(link.dof + 2)] = twist0;
  return true;
}

void JointAngles::resize(const Plan& plan) {
  for (auto* v : {&first_, &second_, &angles_}) v->assign(padded(plan.dofs.size()), 0.0);
}

void JointAngles::read(const BodyTree& tree, int figure, const Plan& plan, std::span<const double> q, State& state) {
  const auto rotation_of = [&](const Link& link) { return quat_from_xyzw(q.subspan(at(tree.q_at(link.segment)), 4)); };
  for (const Link& link : plan.links) {
    if (link.figure != figure) continue;
    const Joint& joint = tree.joint(link.segment);
    const double* share = q.data() + tree.q_at(link.segment);
    double *y = first_.data() + link.dof, *x = second_.data() + link.dof;
    if (link.kind == LinkKind::ball || link.kind == LinkKind::floating) {
      std::copy_n(share, link.kind == LinkKind::ball ? 4 : 7, state.more.data() + link.more);
    } else if (link.kind == LinkKind::limb) {
      read_limb(link, rotation_of(link), state.turns.data() + link.dof, state.more.data() + link.more);
    } else if (joint.type == JointType::universal) {
      const Quat r = rotation_of(link);
      tangent_about(joint.axes[0], joint.axes[1], r * joint.axes[1], y[0], x[0]);
      tangent_about(joint.axes[1], glm::conjugate(r) * joint.axes[0], joint.axes[0], y[1], x[1]);
    } else if (joint.type == JointType::ball) {
      ball_tangents(rotation_of(link), y, x);
    } else if (link.dofs == 1) {
      state.turns[at(link.dof)] = share[0];
    }
  }
  arc_tangents(first_.data(), second_.data(), plan.dofs.size(), angles_.data());
  for (const Link& link : plan.links) {
    if (link.figure != figure || link.kind != LinkKind::axes) continue;
    const Dof* dofs = plan.dofs.data() + link.dof;
    double *turns = state.turns.data() + link.dof, *angles = angles_.data() + link.dof;
    const JointType type = tree.joint(link.segment).type;
    if (type == JointType::universal) {
      turns[0] = home(dofs[0], angles[0]), turns[1] = home(dofs[1], angles[1]);
    } else if (type == JointType::ball) {
      // At a quarter turn of y the other two are one angle, which takes more care.
      if (second_[at(link.dof) + 1] < kQuarterTurn) {
        const auto careful = ball_angles(rotation_of(link), ranges_of(dofs));
        std::copy(careful.begin(), careful.end(), angles);
      } else if (!inside(dofs, angles)) {
        choose_triple(ranges_of(dofs), angles);
      }
      std::copy_n(angles, 3, turns);
    }
  }
}

void JointAngles::write(const BodyTree& tree, int figure, const Plan& plan, const State& state, std::span<double> q) {
  std::copy(state.turns.begin(), state.turns.end(), angles_.begin());
  half_sines(angles_.data(), plan.dofs.size(), first_.data(), second_.data());
  for (const Link& link : plan.links) {
    if (link.figure != figure) continue;
    const Joint& joint = tree.joint(link.segment);
    double* share = q.data() + tree.q_at(link.segment);
    const double* more = state.more.data() + link.more;
    const double *s = first_.data() + link.dof, *c = second_.data() + link.dof;
    const auto put = [](const Quat& r, double* to) {
      const Quat before = quat_from_xyzw(std::span<const double>(to, 4));
      const auto v = xyzw(same_sign(before, r));
      std::copy(v.begin(), v.end(), to);
    };
    const auto quat = [&](int first) { return quat_from_xyzw(std::span<const double>(more + first, 4)); };
    const auto about = [&](const Vec3& axis, int k) { return Quat(c[k], s[k] * axis.x, s[k] * axis.y, s[k] * axis.z); };
    if (link.kind == LinkKind::floating) {
      std::copy_n(more, 3, share);
      put(glm::normalize(quat(3)), share + 3);
    } else if (link.kind == LinkKind::ball) {
      put(glm::normalize(quat(0)), share);
    } else if (link.kind == LinkKind::limb) {
      put(glm::normalize(swing_of(link, {more[0], more[1], more[2]}) * about(link.limb, 2)), share);
    } else if (joint.type == JointType::universal) {
      put(about(joint.axes[0], 0) * about(joint.axes[1], 1), share);
    } else if (joint.type == JointType::ball) {
      put(about(kX, 0) * about(kY, 1) * about(kZ, 2), share);
    } else if (link.dofs == 1) {
      share[0] = state.turns[at(link.dof)];
    }
  }
}

}  // namespace posed::springs
