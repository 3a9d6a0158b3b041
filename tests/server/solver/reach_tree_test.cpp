#include "server/solver/reach_tree.h"

#include <gtest/gtest.h>

#include <string>

#include "server/solver/body_tree.h"
#include "tests/support/figures.h"

namespace posed {
namespace {

// "upper_torso(left_clavicle right_hand)": a node, its sons in brackets.
std::string text(const ReachTree& tree, const std::vector<std::string>& names, int node = 0) {
  const ReachNode& n = tree.nodes[static_cast<std::size_t>(node)];
  std::string out = names[static_cast<std::size_t>(n.segment)];
  for (int son = n.first_son; son >= 0; son = tree.nodes[static_cast<std::size_t>(son)].next_son) {
    out.append(son == n.first_son ? "(" : " ").append(text(tree, names, son));
  }
  return n.first_son < 0 ? out : out + ")";
}

ReachTree reach(const std::vector<int>& parents, const std::vector<char>& active, bool keep_root = false) {
  ReachTree tree;
  ReachTreeBuilder().build(parents, active, keep_root, tree);
  return tree;
}

std::string chain(const ReachTree& tree, const std::vector<std::string>& names, int node) {
  const ReachNode& n = tree.nodes[static_cast<std::size_t>(node)];
  std::string out;
  for (int k = n.begin; k < n.chain_end; ++k) {
    out += names[static_cast<std::size_t>(tree.order[static_cast<std::size_t>(k)])];
  }
  return out;
}

// Figure 15: A - B; B - C, D; C - E, F; D - G. Goals at A, E and G.
const std::vector<std::string> kLetters = {"A", "B", "C", "D", "E", "F", "G"};
const std::vector<int> kFigure15 = {-1, 0, 1, 1, 2, 2, 3};

TEST(ReachTree, OfFigure15) {
  const ReachTree tree = reach(kFigure15, {1, 0, 0, 0, 1, 0, 1});
  EXPECT_EQ(text(tree, kLetters), "A(B(E G))");
  EXPECT_EQ(chain(tree, kLetters, 0), "A");
  EXPECT_EQ(chain(tree, kLetters, 1), "B");
  EXPECT_EQ(chain(tree, kLetters, 2), "CE");
  EXPECT_EQ(chain(tree, kLetters, 3), "DG");
  EXPECT_EQ(tree.order.size(), 6u);  // F is pruned
}

TEST(ReachTree, OfFigure16) {
  const auto body = test::human();
  std::vector<std::string> names;
  for (const Segment& s : body->document().segments) names.push_back(s.name);
  std::vector<char> active(names.size(), 0);
  for (const char* name : {"lower_torso", "left_clavicle", "right_hand"}) {
    active[static_cast<std::size_t>(*body->find_segment(name))] = 1;
  }
  const ReachTree tree = reach({body->parents().begin(), body->parents().end()}, active);
  EXPECT_EQ(text(tree, names), "lower_torso(upper_torso(left_clavicle right_hand))");
}

TEST(ReachTree, BeginsWhereTheGoalsBegin) {
  EXPECT_EQ(text(reach(kFigure15, {0, 0, 0, 0, 1, 0, 0}), kLetters), "E");
  EXPECT_EQ(text(reach(kFigure15, {0, 0, 0, 0, 1, 1, 0}), kLetters), "C(E F)");
  EXPECT_EQ(text(reach(kFigure15, {0, 0, 1, 0, 1, 0, 0}), kLetters), "C(E)");
  EXPECT_EQ(text(reach(kFigure15, {0, 0, 0, 0, 1, 1, 1}), kLetters), "B(C(E F) G)");
}

TEST(ReachTree, OfARootThatCanNotMoveBeginsThere) {
  EXPECT_EQ(text(reach(kFigure15, {0, 0, 0, 0, 1, 0, 0}, true), kLetters), "A(E)");
  EXPECT_EQ(chain(reach(kFigure15, {0, 0, 0, 0, 1, 0, 0}, true), kLetters, 1), "BCE");
}

TEST(ReachTree, OfNoGoalsIsEmpty) {
  EXPECT_TRUE(reach(kFigure15, {0, 0, 0, 0, 0, 0, 0}).nodes.empty());
}

TEST(ReachTree, KeepsSubtreesInOnePiece) {
  const ReachTree tree = reach(kFigure15, {1, 1, 1, 1, 1, 1, 1});
  for (const ReachNode& node : tree.nodes) {
    const ReachNode* parent = node.parent < 0 ? nullptr : &tree.nodes[static_cast<std::size_t>(node.parent)];
    if (parent) {
      EXPECT_TRUE(parent->chain_end <= node.begin && node.end <= parent->end);
    }
    EXPECT_EQ(tree.order[static_cast<std::size_t>(node.chain_end - 1)], node.segment);
  }
}

}  // namespace
}  // namespace posed
