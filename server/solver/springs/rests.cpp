#include "server/solver/springs/rests.h"

#include <algorithm>

namespace posed::springs {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

Rest rest_at(const BodyTree& tree, const Plan& plan, int link, std::span<const double> q, const State& turns) {
  const Link& l = plan.links[at(link)];
  Rest rest;
  rest.link = link;
  if (l.kind == LinkKind::axes) {
    for (int k = 0; k < l.dofs; ++k) rest.at[at(k)] = turns.turns[at(l.dof + k)];
  } else if (l.kind != LinkKind::fixed) {
    const auto values = q.subspan(at(tree.q_at(l.segment)), at(q_size(tree.joint(l.segment).type)));
    std::copy(values.begin(), values.end(), rest.at.begin());
  }
  return rest;
}

void add_rests(const BodyTree& tree, const SpringGoal& goal, int index, std::span<const int> link_of_segment,
               std::span<const double> q, const State& turns, Plan& plan) {
  const double lever = tree.document().lever;
  for (const int joint : std::get<PostureSpring>(goal.spring).joints) {
    Rest rest = rest_at(tree, plan, link_of_segment[at(joint)], q, turns);
    const Link& link = plan.links[at(rest.link)];
    rest.goal = index;
    for (int k = 0; k < link.dofs; ++k) {
      const bool slides =
          plan.dofs[at(link.dof + k)].kind == DofKind::along_axis || (link.kind == LinkKind::floating && k < 3);
      rest.weight[at(k)] = goal.weight * (slides ? 1.0 : lever * lever);
    }
    plan.rests.push_back(rest);
  }
}

void sum_stiffness(Plan& plan) {
  std::fill(plan.stiffness.begin(), plan.stiffness.end(), 0.0);
  for (const Rest& rest : plan.rests) {
    const Link& link = plan.links[at(rest.link)];
    for (int k = 0; k < link.dofs; ++k) plan.stiffness[at(link.dof + k)] += rest.weight[at(k)];
  }
}

}  // namespace posed::springs
