// A plan at one pose, in ordinary numbers: errors of goals, and how each pulls at the joints. For reports, priorities
// and tests; the kernels have their own way.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "server/solver/springs/plan.h"

namespace posed::springs {

struct TermErrors {
  int count = 0;
  std::array<double, 3> error{0.0, 0.0, 0.0};  // m; those that do not count (Term::sense) too
};

class Probe {
 public:
  Probe();
  ~Probe();
  void prepare(const Plan& plan);
  void place(const Plan& plan, const State& state);

  // At the placed pose. Shifts are left out.
  TermErrors errors(const Plan& plan, const Term& term) const;
  // Adds weight x error of what counts, as it pulls at each degree of freedom (the slope of half the cost).
  void pull(const Plan& plan, const Term& term, std::span<double> slope);
  double pull(const Plan& plan, const Rest& rest, std::span<double> slope);  // and its cost

  Vec3 point(int link, const Vec3& point) const;  // in the world
  Transform link(int link) const;                 // world_from_segment
  Vec3 centre_of_mass(const Plan& plan, int figure) const;

  // Of one of a link's degrees of freedom: is it at a bound that keeps it from following -slope (the way down)?
  // `slopes`: of all.
  enum class Bound { none, min, max, swing };
  Bound held(const Plan& plan, const State& state, std::size_t link, std::size_t dof,
             std::span<const double> slopes) const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace posed::springs
