// A joint's orientation as half-plane, deviation and twist (paper, ORIENTATION of Figure 12; Korein 1985): with p the
// limb's direction at rest and q the figure's X axis made perpendicular to p (Y if parallel),
//   R = R_p(h) R_q(d) R_p(t - h),  d in [0, pi],  h = 0 where d = 0.
// Radians. p is the direction from the joint's origin to the touch point (Z for a limb without length).
#pragma once

#include "common/math.h"

namespace posed {

struct Orientation {
  double halfplane = 0.0, deviation = 0.0, twist = 0.0;
};

Quat quat_from_orientation(const Orientation& orientation, const Vec3& limb);
// `quat` is of unit length. Halfplane and twist come out in (-pi, pi]. At d = pi twist and half-plane are not
// independent; twist - 2 h is what counts, and h is 0.
Orientation orientation_from_quat(const Quat& quat, const Vec3& limb);

}  // namespace posed
