#include "server/scene/binding_motion.h"

#include <gtest/gtest.h>

namespace posed {
namespace {

constexpr double kTiny = 1e-12;

TEST(BindingMotion, AbsoluteIsTheOffsetSeenFromTheSensor) {
  Binding binding;
  binding.scale = 2.0;
  const Transform world_from_sensor{{1, 2, 3}, quat_about(kZ, M_PI / 2)};
  EXPECT_EQ(absolute_motion(binding, world_from_sensor).position, Vec3(2, 4, 6));
  EXPECT_EQ(absolute_motion(binding, world_from_sensor).rotation, world_from_sensor.rotation);
  binding.offset = SensorOffset{{0.1, 0, 0}, quat_about(kX, 0.3)};
  const Transform target = absolute_motion(binding, world_from_sensor);
  EXPECT_LT(glm::length(target.position - Vec3(2, 4.1, 6)), kTiny) << "the offset is not scaled";
  EXPECT_LT(glm::length(target.rotation - world_from_sensor.rotation * quat_about(kX, 0.3)), kTiny);
}

TEST(BindingMotion, RelativeMovesAsThePointAtTheOffsetDoes) {
  Binding binding;
  binding.scale = 10.0;
  binding.offset = SensorOffset{{1, 0, 0}, quat_identity()};
  const MotionAnchor from{{{5, 5, 5}, quat_identity()}, {{0, 0, 1}, quat_about(kZ, 0.5)}};
  const Transform turned{{5, 5, 5}, quat_about(kZ, M_PI / 2)};
  const Transform target = relative_motion(binding, from, turned);
  // The point at the offset went from (6,5,5) to (5,6,5).
  EXPECT_LT(glm::length(target.position - Vec3(-10, 10, 1)), kTiny);
  EXPECT_LT(glm::length(target.rotation - quat_about(kZ, 0.5 + M_PI / 2)), kTiny) << "turns are not scaled";
}

TEST(BindingMotion, AxesThatDoNotFollowStay) {
  const Transform rest{{1, 2, 3}, quat_about(kZ, 0.3)}, wanted{{7, 8, 9}, quat_about(kX, 0.4) * quat_about(kZ, 0.7)};
  const Transform place = on_axes({true, false, true}, rest, wanted);
  EXPECT_EQ(place.position, Vec3(7, 2, 9));
  EXPECT_EQ(place.rotation, rest.rotation);
  EXPECT_EQ(on_axes(kAllAxes, rest, wanted).rotation, wanted.rotation);
}

TEST(BindingMotion, OneAxisTakesTheTwistTwoTheRest) {
  const Quat heading = quat_about(kZ, 0.8), tilt = quat_about(kX, 0.3) * quat_about(kY, -0.2);
  Axes z{};
  z.rz = true;
  Axes xy{};
  xy.rx = xy.ry = true;
  // Of a pure twist one axis takes all and the other two nothing.
  EXPECT_LT(glm::length(turn_about(z, heading) - heading), kTiny);
  EXPECT_LT(glm::length(turn_about(xy, heading) - quat_identity()), kTiny);
  // Both parts make the whole, and the part without the twist has none.
  const Quat both = tilt * heading;
  EXPECT_LT(glm::length(turn_about(xy, both) * turn_about(z, both) - both), kTiny);
  EXPECT_NEAR(twist_angle(turn_about(xy, both), kZ), 0.0, kTiny);
  EXPECT_EQ(turn_about(Axes{}, both), quat_identity());
  EXPECT_EQ(turn_about(kTurns, both), both);
}

TEST(BindingMotion, TheTwistIsTheAngleOfAHinge) {
  for (const double angle : {-3.0, -0.5, 0.0, 0.5, 3.0}) {
    EXPECT_NEAR(twist_angle(quat_about(kY, angle), kY), angle, kTiny);
    EXPECT_NEAR(twist_angle(-quat_about(kY, angle), kY), angle, kTiny) << "the sign of a quaternion means nothing";
  }
  // A half turn across the axis has no twist: none is made up.
  EXPECT_EQ(twist_angle(quat_about(kX, M_PI), kZ), 0.0);
}

}  // namespace
}  // namespace posed
