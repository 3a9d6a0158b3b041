#include "server/solver/reach_tree.h"

#include <cstddef>

namespace posed {
namespace {
std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}
}  // namespace

void ReachTreeBuilder::build(std::span<const int> parents, std::span<const char> active, bool keep_root,
                             ReachTree& tree) {
  tree.nodes.clear();
  tree.order.clear();
  active_ = active;
  keep_root_ = keep_root;
  const int n = static_cast<int>(parents.size());
  sons_.assign(parents.size(), 0);
  first_son_.assign(parents.size(), -1);
  next_son_.assign(parents.size(), -1);

  // Pruning. Backwards, so that a segment's sons are known before it is, and are linked in their own order.
  bool any = keep_root;
  for (int i = n - 1; i >= 0; --i) {
    const bool left = active[at(i)] || sons_[at(i)] > 0;
    any = any || left;
    const int parent = parents[at(i)];
    if (!left || parent < 0) continue;
    ++sons_[at(parent)];
    next_son_[at(i)] = first_son_[at(parent)];
    first_son_[at(parent)] = i;
  }
  if (!any || n == 0) return;

  int root = 0;
  while (!(keep_root && root == 0) && !active[at(root)] && sons_[at(root)] == 1) root = first_son_[at(root)];
  visit(root, -1, 0, tree);
}

// Contraction: a segment that neither holds a goal nor branches is a link of the chain to the next node below.
void ReachTreeBuilder::visit(int segment, int parent_node, int begin, ReachTree& tree) {
  tree.order.push_back(segment);
  const bool is_node = active_[at(segment)] || sons_[at(segment)] > 1 || (keep_root_ && segment == 0);
  if (!is_node) return visit(first_son_[at(segment)], parent_node, begin, tree);

  const int node = static_cast<int>(tree.nodes.size());
  ReachNode& fresh = tree.nodes.emplace_back();
  fresh.segment = segment;
  fresh.parent = parent_node;
  fresh.begin = begin;
  fresh.chain_end = static_cast<int>(tree.order.size());

  int last_son = -1;
  for (int son = first_son_[at(segment)]; son >= 0; son = next_son_[at(son)]) {
    const int son_node = static_cast<int>(tree.nodes.size());
    visit(son, node, static_cast<int>(tree.order.size()), tree);
    (last_son < 0 ? tree.nodes[at(node)].first_son : tree.nodes[at(last_son)].next_son) = son_node;
    last_son = son_node;
  }
  tree.nodes[at(node)].end = static_cast<int>(tree.order.size());
}

}  // namespace posed
