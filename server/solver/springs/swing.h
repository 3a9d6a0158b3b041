// Where a limb may point (common/figure.h: Swing), in ordinary numbers; swing-inl.h has it in lanes.
#pragma once

#include <optional>

#include "server/solver/springs/plan.h"

namespace posed::springs {

// Makes a limb of a link that points along `limb` (unit) at rest. Without a swing it points anywhere.
void make_limb(const Vec3& limb, const std::optional<Swing>& swing, Link& link);

// The direction itself where the link's limb may point there, else a near one on the edge. Unit vectors.
Vec3 inside_swing(const Link& link, const Vec3& direction);

}  // namespace posed::springs
