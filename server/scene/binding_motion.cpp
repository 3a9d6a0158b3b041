#include "server/scene/binding_motion.h"

namespace posed {
namespace {

// No twist where the turn is a half turn about an axis across: then there is none to tell.
Quat twist_about(const Quat& turn, const Vec3& axis) {
  const double along = glm::dot(Vec3(turn.x, turn.y, turn.z), axis);
  const double length = std::hypot(turn.w, along);
  if (length < 1e-12) return quat_identity();
  const Vec3 v = axis * (along / length);
  return Quat(turn.w / length, v.x, v.y, v.z);
}

}  // namespace

Transform sensor_from_target(const Binding& binding) {
  if (!binding.offset) return {};
  return {binding.offset->position, binding.offset->rotation};
}

Transform absolute_motion(const Binding& binding, const Transform& world_from_sensor) {
  const Transform scaled{world_from_sensor.position * binding.scale, world_from_sensor.rotation};
  return binding.offset ? scaled * sensor_from_target(binding) : scaled;
}

Transform relative_motion(const Binding& binding, const MotionAnchor& from, const Transform& world_from_sensor) {
  const Transform offset = sensor_from_target(binding);
  const Vec3 moved = world_from_sensor * offset.position - from.world_from_sensor * offset.position;
  const Quat turned = world_from_sensor.rotation * glm::conjugate(from.world_from_sensor.rotation);
  return {from.world_from_target.position + binding.scale * moved,
          glm::normalize(turned * from.world_from_target.rotation)};
}

Quat turn_about(const Axes& axes, const Quat& turn) {
  const int count = axes.rx + axes.ry + axes.rz;
  if (count == 3) return turn;
  if (count == 0) return quat_identity();
  if (count == 1) return twist_about(turn, axes.rx ? kX : axes.ry ? kY : kZ);
  const Vec3 other = !axes.rx ? kX : !axes.ry ? kY : kZ;
  return turn * glm::conjugate(twist_about(turn, other));
}

Transform on_axes(const Axes& axes, const Transform& rest, const Transform& wanted) {
  Transform out = rest;
  if (axes.x) out.position.x = wanted.position.x;
  if (axes.y) out.position.y = wanted.position.y;
  if (axes.z) out.position.z = wanted.position.z;
  if (axes.rx && axes.ry && axes.rz)
    out.rotation = wanted.rotation;
  else if (axes.turns())
    out.rotation = glm::normalize(turn_about(axes, wanted.rotation * glm::conjugate(rest.rotation)) * rest.rotation);
  return out;
}

double twist_angle(const Quat& turn, const Vec3& axis) {
  const Quat twist = twist_about(turn, axis);
  const double angle = 2.0 * std::atan2(glm::dot(Vec3(twist.x, twist.y, twist.z), axis), twist.w);
  return angle > M_PI ? angle - 2.0 * M_PI : angle <= -M_PI ? angle + 2.0 * M_PI : angle;
}

}  // namespace posed
