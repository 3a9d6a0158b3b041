#include "server/solver/springs/probe.h"

#include <algorithm>

#include "server/solver/springs/pull-inl.h"

namespace posed::springs {

namespace here = HWY_NAMESPACE;

struct Probe::Inside {
  here::Kinematics<double> figure;
  here::Newton<double> newton;
  here::Steps<double> at;
  here::Memory<here::Wrench<double>> wrenches;

  // A link's joint feels the wrench on all below it.
  void feel(const Plan& plan, std::size_t i, const here::Wrench<double>& w, std::span<double> slope) const {
    const Link& link = plan.links[i];
    const std::size_t first = link.first_dof();
    if (link.kind == LinkKind::floating) {
      const double parts[6] = {w.shift.x, w.shift.y, w.shift.z, w.turn.x, w.turn.y, w.turn.z};
      for (std::size_t k = 0; k < 6; ++k) slope[first + k] += parts[k];
    } else {
      for (std::size_t j = first; j < first + static_cast<std::size_t>(link.dofs); ++j)
        slope[j] += here::dot(plan.dofs[j].kind == DofKind::along_axis ? w.shift : w.turn, figure.axis(j));
    }
  }
  here::Wrench<double> handed_down(const Plan& plan, std::size_t i, const here::Wrench<double>& w) const {
    const auto arm = figure.placed(static_cast<int>(i)).centre - figure.placed(plan.links[i].parent).centre;
    return {w.turn + here::cross(arm, w.shift), w.shift};
  }

  // Hands the wrenches of all links down to the roots.
  void collect(const Plan& plan, std::span<double> slope) {
    for (std::size_t i = plan.links.size(); i-- > 0;) {
      feel(plan, i, wrenches[i], slope);
      const int parent = plan.links[i].parent;
      if (parent >= 0) wrenches[static_cast<std::size_t>(parent)] += handed_down(plan, i, wrenches[i]);
    }
  }
  // Of one link alone, and forgets it.
  void collect(const Plan& plan, int link, std::span<double> slope) {
    here::Wrench<double> w = newton.load(link).slope;
    newton.load(link).clear();
    for (int i = link; i >= 0; i = plan.links[static_cast<std::size_t>(i)].parent) {
      feel(plan, static_cast<std::size_t>(i), w, slope);
      if (plan.links[static_cast<std::size_t>(i)].parent >= 0) w = handed_down(plan, static_cast<std::size_t>(i), w);
    }
  }
};

Probe::Probe() : inside_(std::make_unique<Inside>()) {}
Probe::~Probe() = default;

void Probe::prepare(const Plan& plan) {
  inside_->figure.resize(plan);
  inside_->newton.resize(plan, 3, std::max<std::size_t>(6, 2 * (plan.links.size() + plan.supports.size())));
  inside_->at.resize(plan);
  inside_->wrenches.resize(plan.links.size());
  inside_->newton.clear();
}

void Probe::place(const Plan& plan, const State& state) {
  std::copy(state.turns.begin(), state.turns.end(), inside_->at.turns.begin());
  std::copy(state.more.begin(), state.more.end(), inside_->at.more.begin());
  inside_->figure.place(plan, inside_->at);
  inside_->figure.see_edges(plan);
}

TermErrors Probe::errors(const Plan& plan, const Term& term) const {
  TermErrors result;
  if (term.kind == TermKind::balance) {
    result.count = 1;
    result.error[0] = here::stand(plan, term, inside_->figure, 0.0).error;
    return result;
  }
  here::Base<double> base;
  if (term.base >= 0) base.placed = &inside_->figure.placed(term.base);
  here::Errors<double> errors;
  here::measure(term, inside_->figure.placed(term.link), base, errors);
  for (int k = 0; k < errors.count; ++k) {
    if (k < errors.real) result.error[static_cast<std::size_t>(result.count++)] = errors.error[k];
  }
  return result;
}

void Probe::pull(const Plan& plan, const Term& term, std::span<double> slope) {
  Inside& in = *inside_;
  Term unshifted = term;
  unshifted.shift = {0.0, 0.0, 0.0};
  in.newton.clear_ties();
  here::pull_term(plan, unshifted, in.figure, in.newton);
  if (term.kind != TermKind::balance) {
    in.collect(plan, term.link, slope);
    if (term.base >= 0) in.collect(plan, term.base, slope);
    return;
  }
  for (std::size_t i = 0; i < plan.links.size(); ++i) in.wrenches[i] = in.newton.load(static_cast<int>(i)).slope;
  in.collect(plan, slope);
  in.newton.clear();
}

double Probe::pull(const Plan& plan, const Rest& rest, std::span<double> slope) {
  Inside& in = *inside_;
  in.newton.clear_springs();
  const double cost = here::pull_rest(plan, rest, in.at, in.figure, in.newton);
  const Link& link = plan.links[static_cast<std::size_t>(rest.link)];
  for (std::size_t j = link.first_dof(); j < link.end_dof(); ++j) slope[j] += in.newton.spring_slope(j);
  return cost;
}

Vec3 Probe::point(int link, const Vec3& point) const {
  const auto& placed = inside_->figure.placed(link);
  const auto p = placed.centre + placed.rotation * here::V3<double>(point);
  return {p.x, p.y, p.z};
}

Transform Probe::link(int link) const {
  const auto& p = inside_->figure.placed(link);
  const auto vec = [](const here::V3<double>& v) { return Vec3(v.x, v.y, v.z); };
  return {vec(p.centre),
          glm::normalize(glm::quat_cast(glm::dmat3(vec(p.rotation.x), vec(p.rotation.y), vec(p.rotation.z))))};
}

Vec3 Probe::centre_of_mass(const Plan& plan, int figure) const {
  Vec3 sum = kZero;
  for (std::size_t i = 0; i < plan.links.size(); ++i) {
    const Link& link = plan.links[i];
    if (link.figure != figure || link.mass <= 0.0) continue;
    sum += point(static_cast<int>(i), link.mass_point) * (link.mass / plan.masses[static_cast<std::size_t>(figure)]);
  }
  return sum;
}

Probe::Bound Probe::held(const Plan& plan, const State& state, std::size_t link, std::size_t dof,
                         std::span<const double> slopes) const {
  constexpr double kNear = 1e-7;
  const double slope = slopes[dof];
  if (slope < 0.0 && state.turns[dof] >= plan.most[dof] - kNear) return Bound::max;
  if (slope > 0.0 && state.turns[dof] <= plan.least[dof] + kNear) return Bound::min;
  if (plan.links[link].kind != LinkKind::limb) return Bound::none;
  const auto& swinging = inside_->figure.swinging(link);
  const auto first = static_cast<std::size_t>(plan.links[link].dof);
  if (dof == first && swinging.on_edge > 0.0 && slope < 0.0) return Bound::swing;
  if (dof == first + 1 && swinging.in_corner(slopes[first], slope)) return Bound::swing;
  return Bound::none;
}

}  // namespace posed::springs
