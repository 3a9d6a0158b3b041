#include "tests/server/solver/goals/derivative_check.h"

#include <gtest/gtest.h>

#include "server/solver/springs/plan_builder.h"
#include "server/solver/springs/probe.h"
#include "server/solver/springs/pull-inl.h"
#include "server/solver/springs/rests.h"
#include "server/solver/springs/starts.h"
#include "server/solver/springs/terms.h"
#include "tests/support/joint_angles.h"

namespace posed::test {
namespace {

namespace here = springs::HWY_NAMESPACE;
using springs::Link;
using springs::LinkKind;
using springs::State;
using springs::Term;

constexpr double kStep = 1e-6;

// A goal laid out for the solver.
struct Laid {
  springs::Plan plan;
  std::vector<std::vector<int>> link_of_segment;
  std::vector<Term> terms;
  State state;
  springs::Probe probe;

  Laid(const Figures& figures, const SpringGoal& goal, const AllQ& q) : link_of_segment(figures.size()) {
    std::vector<std::vector<char>> active;
    for (const auto& figure : figures) active.emplace_back(figure->size(), 0);
    springs::mark_active(goal, figures, active);
    for (std::size_t f = 0; f < figures.size(); ++f)
      springs::add_figure(*figures[f], static_cast<int>(f), active[f], plan, link_of_segment[f]);
    springs::add_terms(goal, 0, figures, link_of_segment, plan, terms);
    plan.terms = terms;
    springs::resize(plan, state);
    for (std::size_t f = 0; f < figures.size(); ++f) test::read_q(*figures[f], static_cast<int>(f), plan, q[f], state);
    set_posture(figures, goal, q);
    probe.prepare(plan);
    probe.place(plan, state);
  }

  // As the solver writes it for one posture goal.
  void set_posture(const Figures& figures, const SpringGoal& goal, const AllQ& q) {
    const auto* posture = std::get_if<PostureSpring>(&goal.spring);
    if (!posture) return;
    const auto f = static_cast<std::size_t>(goal.figure);
    const BodyTree& tree = *figures[f];
    std::vector<double> wanted = q[f];
    std::size_t next = 0;
    for (const int j : posture->joints) {
      for (int k = 0; k < q_size(tree.joint(j).type); ++k)
        wanted[static_cast<std::size_t>(tree.q_at(j) + k)] = posture->values[next++];
    }
    State rest = state;
    test::read_q(tree, goal.figure, plan, wanted, rest);
    springs::add_rests(tree, goal, 0, link_of_segment[f], wanted, rest, plan);
    springs::sum_stiffness(plan);
  }

  std::vector<double> pull(std::size_t dofs) {
    std::vector<double> slope(dofs, 0.0);
    for (const Term& term : plan.terms) probe.pull(plan, term, slope);
    for (const springs::Rest& rest : plan.rests) (void)probe.pull(plan, rest, slope);
    return slope;
  }
};

void turn(const Vec3& axis, double by, double* quat) {
  const auto v = xyzw(quat_about(axis, by) * quat_from_xyzw(std::span<const double>(quat, 4)));
  std::copy(v.begin(), v.end(), quat);
}

// The state with degree of freedom k of a link moved, as the kernels mean it.
State moved(const springs::Plan& plan, State state, std::size_t i, int k, double by) {
  const Link& link = plan.links[i];
  double* more = state.more.data() + link.more;
  const Vec3 axes[3] = {kX, kY, kZ};
  if (link.kind == LinkKind::floating && k < 3) {
    more[k] += by;
  } else if (link.kind == LinkKind::floating) {
    turn(axes[k - 3], by, more + 3);
  } else if (link.kind == LinkKind::ball) {
    turn(axes[k], by, more);
  } else if (link.kind == LinkKind::limb && k < 2) {
    here::Swinging<double> swinging;
    swinging.point(link, {more[0], more[1], more[2]});
    swinging.see(link);
    const auto& way = k == 0 ? swinging.out : swinging.along;
    const Vec3 d = glm::normalize(Vec3(more[0], more[1], more[2]) + Vec3(way.x, way.y, way.z) * by);
    more[0] = d.x, more[1] = d.y, more[2] = d.z;
  } else {
    state.turns[static_cast<std::size_t>(link.dof + k)] += by;
  }
  return state;
}

void check_pull(const Figures& figures, const SpringGoal& goal, const AllQ& q, Laid& laid) {
  const auto slope = laid.pull(laid.plan.dofs.size());
  const auto cost = [&](const State& state) {
    AllQ there = q;
    for (std::size_t f = 0; f < figures.size(); ++f)
      test::write_q(*figures[f], static_cast<int>(f), laid.plan, state, there[f]);
    return cost_of(figures, std::span(&goal, 1), there);
  };
  const double scale = std::max(1.0, goal.weight + cost(laid.state));
  for (std::size_t i = 0; i < laid.plan.links.size(); ++i) {
    const Link& link = laid.plan.links[i];
    for (int k = 0; k < link.dofs; ++k) {
      const double change =
          (cost(moved(laid.plan, laid.state, i, k, kStep)) - cost(moved(laid.plan, laid.state, i, k, -kStep))) /
          (4.0 * kStep);
      EXPECT_NEAR(slope[static_cast<std::size_t>(link.dof + k)], change, 2e-7 * scale)
          << figures[static_cast<std::size_t>(link.figure)]->segment(link.segment).name << " " << k;
    }
  }
}

here::Placed<double> placed(const Transform& t) {
  const auto v = [&](const Vec3& a) { return here::V3<double>(t.rotation * a); };
  return {{v(kX), v(kY), v(kZ)}, here::V3<double>(t.position)};
}

Transform pushed(const Transform& t, int k, double by) {
  const Vec3 axes[3] = {kX, kY, kZ};
  if (k < 3) return {t.position, quat_about(axes[k], by) * t.rotation};
  return {t.position + axes[k - 3] * by, t.rotation};
}

void check_rows(const Laid& laid) {
  for (const Term& term : laid.plan.terms) {
    if (term.kind == springs::TermKind::balance) continue;
    const Transform segment = laid.probe.link(term.link);
    const Transform base = term.base >= 0 ? laid.probe.link(term.base) : Transform{};
    const auto errors = [&](const Transform& s, const Transform& b) {
      const here::Placed<double> there = placed(s), from = placed(b);
      here::Base<double> of;
      if (term.base >= 0) of.placed = &from;
      here::Errors<double> out;
      here::measure(term, there, of, out);
      return out;
    };
    const auto here_and_now = errors(segment, base);
    const Vec3 apart = segment.position - base.position;
    for (int e = 0; e < here_and_now.count; ++e) {
      if (e >= here_and_now.real) break;
      const auto& row = here_and_now.row[e];
      const double along[6] = {row.turn.x, row.turn.y, row.turn.z, row.shift.x, row.shift.y, row.shift.z};
      const Vec3 shift(along[3], along[4], along[5]);
      const Vec3 back_turn = -(Vec3(along[0], along[1], along[2]) + glm::cross(apart, shift));
      for (int k = 0; k < 6; ++k) {
        const auto change = [&](double by) { return errors(pushed(segment, k, by), base).error[e]; };
        EXPECT_NEAR(along[k], (change(kStep) - change(-kStep)) / (2.0 * kStep), 1e-6)
            << "error " << e << " motion " << k;
        if (term.base < 0) continue;
        // A motion of the base is the opposite motion of the segment about it.
        const auto change_of_base = [&](double by) {
          const Transform push = pushed(base, k, by) * inverse(base);
          return errors(inverse(push) * segment, base).error[e];
        };
        EXPECT_NEAR(k < 3 ? back_turn[k] : -shift[k - 3],
                    (change_of_base(kStep) - change_of_base(-kStep)) / (2.0 * kStep), 1e-6)
            << "error " << e << " motion of the base " << k;
      }
    }
  }
}

AllQ random_poses(std::mt19937& random, const Figures& figures) {
  AllQ q;
  for (const auto& figure : figures) q.push_back(random_q(random, *figure));
  return q;
}

}  // namespace

double solver_error(const Figures& figures, const SpringGoal& goal, const AllQ& q) {
  const Laid laid(figures, goal, q);
  double sum = 0.0;
  for (const Term& term : laid.terms) {
    const springs::TermErrors errors = laid.probe.errors(laid.plan, term);
    for (int k = 0; k < errors.count; ++k) {
      const double e = here::sensed(term.sense, errors.error[static_cast<std::size_t>(k)]);
      sum += e * e;
    }
  }
  return std::sqrt(sum);
}

void check_derivatives(const Figures& figures, const SpringGoal& goal, const AllQ& q) {
  Laid laid(figures, goal, q);
  if (!std::holds_alternative<PostureSpring>(goal.spring)) {
    const SquareError square = square_error(figures, goal, q);
    EXPECT_NEAR(solver_error(figures, goal, q), std::sqrt(square.place + square.turn), 1e-9);
    check_rows(laid);
  }
  check_pull(figures, goal, q, laid);
}

void check_alone_at_random(const MakeGoal& make) {
  std::mt19937 random(21);
  const Figures one = {build(all_joints())};
  for (int n = 0; n < kPoses; ++n) {
    SCOPED_TRACE(n);
    check_derivatives(one, make(random, *one[0]), random_poses(random, one));
  }
}

void check_at_random(const MakeGoal& make) {
  std::mt19937 random(22);
  const Figures two = {build(all_joints()), build(all_joints(JointType::universal))};
  for (int n = 0; n < kPoses; ++n) {
    SCOPED_TRACE(n);
    SpringGoal goal = make(random, *two[0]);
    goal.world_from_base = {random_point(random, 0.5), random_turn(random)};
    if (n % 3 > 0) goal.base_segment = two[0]->find_segment("boxed").value(), goal.base_figure = n % 3 - 1;
    check_derivatives(two, goal, random_poses(random, two));
  }
}

Vec3 random_way(std::mt19937& random) {
  return glm::normalize(random_point(random, 1.0) + Vec3(1e-3, 0.0, 0.0));
}

Quat random_turn(std::mt19937& random) {
  const Vec3 v = random_point(random, 1.0);
  return glm::normalize(Quat(uniform(random, -1.0, 1.0), v.x, v.y, v.z));
}

std::shared_ptr<const BodyTree> lone_segment() {
  FigureDocument d = column(1, 0.0);
  d.segments[0].name = d.root = "only";
  return build(d);
}

}  // namespace posed::test
