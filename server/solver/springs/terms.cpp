#include "server/solver/springs/terms.h"

#include <algorithm>

namespace posed::springs {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

Sense sense_of(DistanceSpring::Compare compare) {
  switch (compare) {
    case DistanceSpring::Compare::at_least:
      return Sense::at_least;
    case DistanceSpring::Compare::at_most:
      return Sense::at_most;
    case DistanceSpring::Compare::equal:
      break;
  }
  return Sense::equal;
}

TermKind kind_of(const Spring& spring) {
  return std::visit(
      Overloaded{
          [](const PositionSpring&) { return TermKind::point; },
          [](const OrientationSpring&) { return TermKind::turn; }, [](const PoseSpring&) { return TermKind::point; },
          [](const AimSpring&) { return TermKind::aim; }, [](const PlaneSpring&) { return TermKind::plane; },
          [](const LineSpring&) { return TermKind::line; }, [](const DistanceSpring&) { return TermKind::distance; },
          [](const BalanceSpring&) { return TermKind::balance; }, [](const PostureSpring&) { return TermKind::point; }},
      spring);
}

bool holds_nowhere(const SpringGoal& goal) {
  return std::holds_alternative<BalanceSpring>(goal.spring) || std::holds_alternative<PostureSpring>(goal.spring);
}

}  // namespace

void mark_active(const SpringGoal& goal, Figures figures, std::vector<std::vector<char>>& active) {
  if (!holds_nowhere(goal)) active[at(goal.figure)][at(goal.at.segment)] = 1;
  if (goal.base_segment >= 0) active[at(goal.base_figure)][at(goal.base_segment)] = 1;
  if (const auto* d = std::get_if<DistanceSpring>(&goal.spring)) active[at(goal.base_figure)][at(d->to.segment)] = 1;
  if (const auto* p = std::get_if<PostureSpring>(&goal.spring)) {
    for (const int joint : p->joints) active[at(goal.figure)][at(joint)] = 1;
  }
  if (std::holds_alternative<BalanceSpring>(goal.spring)) {
    for (int i = 0; i < figures[at(goal.figure)]->size(); ++i) active[at(goal.figure)][at(i)] = 1;
  }
}

void add_terms(const SpringGoal& goal, int index, Figures figures, const std::vector<std::vector<int>>& link_of_segment,
               Plan& plan, std::vector<Term>& terms) {
  if (std::holds_alternative<PostureSpring>(goal.spring)) return;
  Term term;
  term.kind = kind_of(goal.spring);
  term.goal = index;
  const std::vector<int>& links = link_of_segment[at(goal.figure)];
  if (goal.base_segment >= 0) term.base = link_of_segment[at(goal.base_figure)][at(goal.base_segment)];
  if (const auto* d = std::get_if<DistanceSpring>(&goal.spring))
    term.base = link_of_segment[at(goal.base_figure)][at(d->to.segment)];
  if (const auto* b = std::get_if<BalanceSpring>(&goal.spring)) {
    term.figure = goal.figure;
    term.first_support = static_cast<int>(plan.supports.size());
    term.supports = static_cast<int>(b->support.size());
    for (const AttachedPoint& p : b->support) plan.supports.push_back({links[at(p.segment)], p.point});
  } else {
    term.link = links[at(goal.at.segment)];
  }
  terms.push_back(term);
  if (std::holds_alternative<PoseSpring>(goal.spring)) {
    term.kind = TermKind::turn;
    terms.push_back(term);
  }
  update_terms(goal, figures, std::span(terms).last(std::holds_alternative<PoseSpring>(goal.spring) ? 2 : 1));
}

std::size_t update_terms(const SpringGoal& goal, Figures figures, std::span<Term> terms) {
  if (std::holds_alternative<PostureSpring>(goal.spring)) return 0;
  Term& term = terms[0];
  // What stands still is brought to the world here; what moves stays in its link's frame.
  const Transform base = term.base >= 0 ? Transform{} : goal.world_from_base;
  const auto point = [&](const Vec3& p) { return base * p; };
  const auto way = [&](const Vec3& v) { return base.rotation * v; };
  term.point = goal.at.point;
  term.lever = figures[at(goal.figure)]->document().lever;
  term.weight = goal.enabled ? goal.weight : 0.0;
  term.shift = {0.0, 0.0, 0.0};
  std::visit(Overloaded{[&](const PositionSpring& s) { term.place = point(s.position); },
                        [&](const OrientationSpring& s) { term.rotation = base.rotation * s.rotation; },
                        [&](const PoseSpring& s) {
                          term.place = point(s.position);
                          terms[1].lever = term.lever;
                          terms[1].rotation = base.rotation * s.rotation;
                          terms[1].weight = goal.enabled ? goal.orientation_weight : 0.0;
                          terms[1].shift = {0.0, 0.0, 0.0};
                        },
                        [&](const AimSpring& s) {
                          term.axis = s.axis;
                          term.at_point = s.at_point;
                          if (s.at_point)
                            term.place = point(s.to);
                          else
                            term.direction = way(s.to);
                        },
                        [&](const PlaneSpring& s) {
                          term.place = point(s.point);
                          term.direction = way(s.normal);
                          term.sense = s.above ? Sense::at_least : Sense::equal;
                        },
                        [&](const LineSpring& s) {
                          term.place = point(s.point);
                          term.direction = way(s.direction);
                        },
                        [&](const DistanceSpring& s) {
                          term.place = s.to.point;
                          term.length = s.length;
                          term.sense = sense_of(s.compare);
                        },
                        [&](const BalanceSpring& s) {
                          term.margin = s.margin;
                          term.sense = Sense::at_most;
                        },
                        [&](const PostureSpring&) {}},
             goal.spring);
  return std::holds_alternative<PoseSpring>(goal.spring) ? 2 : 1;
}

}  // namespace posed::springs
