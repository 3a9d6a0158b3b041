#include "server/scene/mirror.h"

namespace posed {

std::vector<double> mirrored(const BodyTree& tree, std::span<const double> q) {
  std::vector<int> partner(static_cast<std::size_t>(tree.size()));
  for (int i = 0; i < tree.size(); ++i) partner[static_cast<std::size_t>(i)] = i;
  for (const auto& [left, right] : tree.document().mirror) {
    const int a = *tree.find_segment(left), b = *tree.find_segment(right);
    if (tree.joint(a).type != tree.joint(b).type) continue;
    partner[static_cast<std::size_t>(a)] = b;
    partner[static_cast<std::size_t>(b)] = a;
  }
  std::vector<double> out(q.begin(), q.end());
  for (int i = 0; i < tree.size(); ++i) {
    const JointType type = tree.joint(i).type;
    const auto from = static_cast<std::size_t>(tree.q_at(partner[static_cast<std::size_t>(i)]));
    const auto to = static_cast<std::size_t>(tree.q_at(i));
    const std::size_t turn = type == JointType::free ? 3 : 0;
    if (type == JointType::free || type == JointType::ball || type == JointType::universal) {
      // A reflection in y turns rotation axes (x, y, z) into (-x, y, -z).
      out[to + turn] = -q[from + turn];
      out[to + turn + 1] = q[from + turn + 1];
      out[to + turn + 2] = -q[from + turn + 2];
      out[to + turn + 3] = q[from + turn + 3];
    } else if (q_size(type) == 1) {
      out[to] = q[from];
    }
  }
  return out;
}

}  // namespace posed
