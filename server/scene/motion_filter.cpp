#include "server/scene/motion_filter.h"

#include <algorithm>

namespace posed {
namespace {

constexpr double kPredictorCutoff = 10.0;  // Hz: of its velocity

double share_of_new(double dt, double cutoff_hz) {
  return 1.0 / (1.0 + 1.0 / (2.0 * M_PI * cutoff_hz * dt));
}

// The turn from `a` to `b` in the world's axes, as a rotation vector.
Vec3 turn_between(const Quat& a, const Quat& b) {
  const Quat turn = same_sign(quat_identity(), b * glm::conjugate(a));
  const Vec3 v(turn.x, turn.y, turn.z);
  const double s = glm::length(v);
  return s < 1e-12 ? 2.0 * v : v * (2.0 * std::atan2(s, turn.w) / s);
}

Quat turned(const Vec3& by, const Quat& q) {
  const double angle = glm::length(by);
  return angle < 1e-12 ? q : glm::normalize(quat_about(by / angle, angle) * q);
}

Vec3 at_most(const Vec3& v, double length) {
  const double own = glm::length(v);
  return own > length ? v * (length / own) : v;
}

}  // namespace

Transform MotionFilter::next(const BindingFilter& how, const Transform& raw, Nanoseconds t_ns) {
  if (begun_ && t_ns == t_ns_) return out_;
  if (!begun_ || t_ns < t_ns_ || t_ns - t_ns_ > kGap) {
    *this = {};
    begun_ = true;
    t_ns_ = t_ns;
    return filtered_ = out_ = raw;
  }
  const double dt = 1e-9 * static_cast<double>(t_ns - t_ns_);
  t_ns_ = t_ns;
  const Transform before = filtered_;
  if (how.one_euro) {
    const OneEuro& f = *how.one_euro;
    const double d = share_of_new(dt, f.d_cutoff_hz);
    const Vec3 turn = turn_between(filtered_.rotation, raw.rotation);
    slope_ += d * ((raw.position - filtered_.position) / dt - slope_);
    turn_slope_ += d * (turn / dt - turn_slope_);
    const double move_share = share_of_new(dt, f.min_cutoff_hz + f.beta * glm::length(slope_));
    const double turn_share = share_of_new(dt, f.min_cutoff_hz + f.beta * glm::length(turn_slope_));
    filtered_.position += move_share * (raw.position - filtered_.position);
    filtered_.rotation = turned(turn_share * turn, filtered_.rotation);
  } else {
    filtered_ = raw;
  }
  out_ = filtered_;
  if (how.predict_ms > 0.0) {
    const double p = share_of_new(dt, kPredictorCutoff);
    velocity_ += p * ((filtered_.position - before.position) / dt - velocity_);
    turn_velocity_ += p * (turn_between(before.rotation, filtered_.rotation) / dt - turn_velocity_);
    const double ahead = 1e-3 * how.predict_ms;
    out_.position += at_most(velocity_ * ahead, kMostAhead);
    out_.rotation = turned(at_most(turn_velocity_ * ahead, kMostTurnAhead), out_.rotation);
  }
  return out_;
}

}  // namespace posed
