#include "server/solver/reach_pose.h"

#include <algorithm>

#include "server/solver/kinematics.h"

namespace posed {
namespace {
std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}
}  // namespace

ReachPose::ReachPose(const BodyTree& tree, const ReachTree& reach) : tree_(tree), reach_(reach) {
  chain_.reserve(at(tree.size()));
  chain_segments_.reserve(at(tree.size()));
}

template <class F>
void ReachPose::each_share(const ReachNode& node, F f) const {
  const bool is_root = node.parent < 0;
  if (is_root) f(std::size_t{0}, std::size_t{3});  // the body root's position; its own joint and those above never bend
  for (int k = is_root ? node.chain_end : node.begin; k < node.end; ++k) {
    const int i = reach_.order[at(k)];
    const int size = q_size(tree_.joint(i).type);
    if (size > 0) f(at(tree_.q_at(i)), at(size));
  }
}

void ReachPose::resize() {
  // Nodes are balanced one inside the other, so the deepest path needs all its levels at once.
  std::vector<std::size_t> depth(reach_.nodes.size(), 0);
  std::size_t deepest = 0;
  for (std::size_t n = 0; n < depth.size(); ++n) {
    const ReachNode& node = reach_.nodes[n];
    depth[n] = node.parent < 0 ? 0 : depth[at(node.parent)];
    each_share(node, [&](std::size_t, std::size_t size) { depth[n] += size; });
    deepest = std::max(deepest, depth[n]);
  }
  undo_.resize(deepest);
}

void ReachPose::begin(std::span<double> q, std::span<Transform> world_from_segment) {
  q_ = q;
  world_ = world_from_segment;
  undo_top_ = 0;
}

Vec3 ReachPose::world_point(int segment, const Vec3& point) const {
  return world_[at(segment)] * point;
}

bool ReachPose::bend_chain(const ReachNode& node, const Vec3& tip, const Vec3& target) {
  chain_.clear();
  chain_segments_.clear();
  for (int k = node.begin; k < node.chain_end; ++k) {
    const int i = reach_.order[at(k)];
    const Joint& joint = tree_.joint(i);
    if (!bends_as_ball(joint.type)) continue;
    const Quat world_from_frame = world_[at(tree_.parent(i))].rotation * joint.parent_from_joint.rotation;
    chain_.push_back(
        {world_[at(i)].position, world_from_frame, joint.bend_axis, quat_from_xyzw(q_.subspan(at(tree_.q_at(i)), 4))});
    chain_segments_.push_back(i);
  }
  if (chain_.empty()) return false;
  solve_simple_chain(chain_, tip, target);
  for (std::size_t k = 0; k < chain_.size(); ++k) {
    const auto r = xyzw(chain_[k].rotation);
    std::copy(r.begin(), r.end(), q_.begin() + tree_.q_at(chain_segments_[k]));
  }
  refresh(node.begin, node.end);
  return true;
}

void ReachPose::translate(const Vec3& by) {
  q_[0] += by.x, q_[1] += by.y, q_[2] += by.z;
  carry(by);
}

void ReachPose::carry(const Vec3& by) {
  world_[at(reach_.order[0])].position += by;
  refresh(1, static_cast<int>(reach_.order.size()));
}

void ReachPose::refresh(int begin, int end) {
  for (int k = begin; k < end; ++k) {
    const int i = reach_.order[at(k)];
    world_[at(i)] = place_segment(tree_, i, q_, world_[at(tree_.parent(i))]);
  }
}

std::size_t ReachPose::save(const ReachNode& node) {
  const std::size_t mark = undo_top_;
  each_share(node, [&](std::size_t first, std::size_t size) {
    std::copy_n(&q_[first], size, &undo_[undo_top_]);
    undo_top_ += size;
  });
  return mark;
}

void ReachPose::restore(const ReachNode& node, std::size_t mark) {
  const bool is_root = node.parent < 0;
  const Vec3 strayed = is_root ? root_position() : kZero;
  std::size_t from = mark;
  each_share(node, [&](std::size_t first, std::size_t size) {
    std::copy_n(&undo_[from], size, &q_[first]);
    from += size;
  });
  undo_top_ = mark;
  if (is_root) {
    carry(root_position() - strayed);
  } else {
    refresh(node.begin, node.end);
  }
}

}  // namespace posed
