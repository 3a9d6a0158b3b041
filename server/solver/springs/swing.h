// Where a limb may point (common/figure.h: Swing), in ordinary numbers; swing-inl.h has it in lanes.
#pragma once

#include "server/solver/springs/plan.h"

namespace posed::springs {

// The direction itself where the link's limb may point there, else a near one on the edge. Unit vectors.
Vec3 inside_swing(const Link& link, const Vec3& direction);

}  // namespace posed::springs
