// The pose that the balancing moves: joint values and the world transforms of the segments in the reach tree, kept in
// step with each other (Figure 17 forgets the second), with a stack of values to go back to.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "server/solver/body_tree.h"
#include "server/solver/reach_tree.h"
#include "server/solver/simple_chain.h"

namespace posed {

class ReachPose {
 public:
  // Both are kept by reference. Call `resize` whenever `reach` has been built anew; nothing else allocates.
  ReachPose(const BodyTree& tree, const ReachTree& reach);
  void resize();

  // `q` with unit quaternions and all world transforms for it; both are changed in place.
  void begin(std::span<double> q, std::span<Transform> world_from_segment);

  Vec3 world_point(int segment, const Vec3& point) const;

  // Bends the simple chain between a node and its parent so that the node's point at `tip` goes to `target` or near.
  // False: no joint of the chain bends.
  bool bend_chain(const ReachNode& node, const Vec3& tip, const Vec3& target);

  // Moves the body root, whose joint is free, and with it the whole figure.
  void translate(const Vec3& by);

  // Saves what bend_chain or (of the root node) translate and all that follows below the node can change; returns the
  // mark to go back to, innermost first, or to drop.
  // The root node may be saved only where the body root is free.
  std::size_t save(const ReachNode& node);
  void restore(const ReachNode& node, std::size_t mark);
  void drop(std::size_t mark) { undo_top_ = mark; }

 private:
  Vec3 root_position() const { return {q_[0], q_[1], q_[2]}; }  // of a free root
  void carry(const Vec3& by);                                   // the reach tree's world transforms after the body root
  void refresh(int begin, int end);
  // Calls f(first, size) for each run of q that belongs to the node.
  template <class F>
  void each_share(const ReachNode& node, F f) const;

  const BodyTree& tree_;
  const ReachTree& reach_;
  std::span<double> q_;
  std::span<Transform> world_;
  std::vector<ChainJoint> chain_;
  std::vector<int> chain_segments_;
  std::vector<double> undo_;
  std::size_t undo_top_ = 0;
};

}  // namespace posed
