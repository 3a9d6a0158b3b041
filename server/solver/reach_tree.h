// The reach tree: those segments of the body tree that hold an active goal, or where branches that hold some meet
// (paper, "Reach trees", Figures 14 to 16). A node hangs on its parent by a simple chain of segments, which can be bent
// without touching a goal outside the node's own subtree.
#pragma once

#include <span>
#include <vector>

namespace posed {

struct ReachNode {
  int segment = 0;
  int parent = -1;  // nodes; -1: none
  int first_son = -1;
  int next_son = -1;  // of the same parent
  // Indices into ReachTree::order. [begin, chain_end) is the simple chain, from the segment below the parent's to this
  // node's own; [begin, end) adds the subtree: all that moves when the chain bends.
  int begin = 0;
  int chain_end = 0;
  int end = 0;
};

struct ReachTree {
  std::vector<ReachNode> nodes;  // parents first; [0] is the root, whose chain is its segment alone
  std::vector<int> order;        // the segments that are left after pruning, parents first, subtrees in one piece
};

class ReachTreeBuilder {
 public:
  // `parents`: of each segment, parents first, -1 for the root. `active`: one flag a segment. `keep_root`: the body
  // root is a node whatever it holds, because it can not follow its goals. Reuses the memory of `tree` and of the
  // builder.
  void build(std::span<const int> parents, std::span<const char> active, bool keep_root, ReachTree& tree);

 private:
  void visit(int segment, int parent_node, int begin, ReachTree& tree);

  std::span<const char> active_;
  std::vector<int> sons_;       // sons that are left after pruning
  std::vector<int> first_son_;  // of those
  std::vector<int> next_son_;
  bool keep_root_ = false;
};

}  // namespace posed
