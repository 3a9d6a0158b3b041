#include "server/solver/springs/swing.h"

#include "server/solver/springs/swing-inl.h"

namespace posed::springs {

Vec3 inside_swing(const Link& link, const Vec3& direction) {
  const auto d = HWY_NAMESPACE::kept_inside(link, HWY_NAMESPACE::V3<double>(direction));
  return {d.x, d.y, d.z};
}

}  // namespace posed::springs
