#include "server/solver/springs/swing.h"

#include <algorithm>
#include <cmath>

#include "server/solver/springs/swing-inl.h"

namespace posed::springs {

void make_limb(const Vec3& limb, const std::optional<Swing>& swing, Link& link) {
  link.kind = LinkKind::limb;
  link.limb = limb;
  link.side = perpendicular(limb, kX);
  link.swings_freely = !swing;
  if (!swing) return;
  link.swing = *swing;
  Vec3& center = link.swing.center;
  if (center == kZero) center = limb;
  const Vec3 first = perpendicular(center, std::abs(center.x) > 0.999999 ? kY : kX);
  link.swing_axes = {first, glm::cross(center, first)};
  if (swing->kind == Swing::Kind::ellipse) link.surely_inside = std::cos(std::min(swing->radii[0], swing->radii[1]));
}

Vec3 inside_swing(const Link& link, const Vec3& direction) {
  const auto d = HWY_NAMESPACE::kept_inside(link, HWY_NAMESPACE::V3<double>(direction));
  return {d.x, d.y, d.z};
}

}  // namespace posed::springs
