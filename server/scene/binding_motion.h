// Where a sensor takes what is bound to it: pure arithmetic on values, no scene and no time.
#pragma once

#include "common/binding.h"
#include "common/math.h"

namespace posed {

// Where the sensor and its target stood when a relative motion began.
struct MotionAnchor {
  Transform world_from_sensor, world_from_target;
};

Transform sensor_from_target(const Binding& binding);

// Absolute: the target is where the offset has it, seen from the sensor whose position is scaled about the world's
// origin.
Transform absolute_motion(const Binding& binding, const Transform& world_from_sensor);

// Relative: the target moves as the point at the offset does, times the scale, and turns as the sensor does, about its
// own place; all in the world's axes.
Transform relative_motion(const Binding& binding, const MotionAnchor& from, const Transform& world_from_sensor);

// `wanted` on the axes that follow, `rest` on the others.
Transform on_axes(const Axes& axes, const Transform& rest, const Transform& wanted);

// The part of a turn that these axes of the world take: all three take all of it, one takes the twist about it, two
// take what is left without the twist about the third. The axes x, y and z of `axes` mean nothing here.
Quat turn_about(const Axes& axes, const Quat& turn);

// How far a turn twists about the unit vector `axis`, rad in (-pi, pi].
double twist_angle(const Quat& turn, const Vec3& axis);

}  // namespace posed
