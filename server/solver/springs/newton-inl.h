// One damped Newton step of a figure, joint by joint from the leaves to the roots, as in articulated-body dynamics
// (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 7): each joint takes one rank out of its segment's
// matrix for every degree of freedom. Goals add to their own segment only, so the cost is linear in the reach tree's
// size. What ties several segments (a goal relative to another segment, balance) is a row for each error on top of the
// tree, brought in by Woodbury's formula.
#if defined(POSED_SPRINGS_NEWTON_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_SPRINGS_NEWTON_INL_H_
#undef POSED_SPRINGS_NEWTON_INL_H_
#else
#define POSED_SPRINGS_NEWTON_INL_H_
#endif

#include <type_traits>

#include "server/solver/springs/kinematics-inl.h"
#include "server/solver/springs/load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

template <class T>
class Newton {
 public:
  // Memory for `ties` rows of `tie_parts` parts in all.
  void resize(const Plan& plan, std::size_t ties, std::size_t tie_parts) {
    loads_.resize(plan.links.size());
    slopes_.resize(plan.links.size());
    motions_.resize(plan.links.size());
    roots_.resize(plan.links.size());
    columns_.resize(plan.dofs.size());
    spring_slopes_.resize(plan.dofs.size());
    stops_.resize(plan.dofs.size());
    stopped_.resize(plan.dofs.size());
    ties_.reserve(ties);
    parts_.reserve(tie_parts);
    tie_matrix_.resize(ties * ties);
    tie_slopes_.resize(ties);
    // The last share is the tree's own.
    tie_columns_.resize((ties + 1) * plan.dofs.size());
    tie_roots_.resize((ties + 1) * plan.links.size());
  }

  void clear() {
    for (Load<T>& load : loads_) load.clear();
    clear_ties();
  }
  void clear_ties() {
    ties_.clear();
    parts_.clear();
  }
  Load<T>& load(int link) { return loads_[static_cast<std::size_t>(link)]; }
  // The slope of a degree of freedom's own springs; Plan::stiffness has their weight.
  T& spring_slope(std::size_t dof) { return spring_slopes_[dof]; }
  void clear_springs() {
    for (std::size_t dof = 0; dof < columns_.size(); ++dof) spring_slopes_[dof] = T(0.0);
  }

  // A row over several segments. Parts are added after it.
  void add_tie(const T& weight) { ties_.add() = {weight, parts_.size(), parts_.size()}; }
  void add_part(int link, const Wrench<T>& row) {
    parts_.add() = {link, row};
    ++ties_[ties_.size() - 1].end;
  }

  // Eliminates all joints. `damping` times a degree of freedom's effort is added to its pivot; `newton` is 1 where the
  // terms of second order count, else 0. False in a lane whose quadratic has no minimum. `gain` gets what the quadratic
  // promises to lose.
  Mask<T> factor(const Plan& plan, const Steps<T>& at, const Kinematics<T>& figure, const T& damping, bool by_effort,
                 const T& newton, T& gain) {
    T concave(0.0);
    gain = T(0.0);
    for (std::size_t i = plan.links.size(); i-- > 0;) {
      const Link& link = plan.links[i];
      Load<T>& load = loads_[i];
      if (link.kind == LinkKind::floating) {
        factor_root(plan, link, damping, by_effort, newton, concave, load, roots_[i]);
        motions_[i] = root_motion(plan, link, i, load.slope, gain);
        continue;
      }
      const auto first = static_cast<std::size_t>(link.dof);
      const auto out = [&]<int kDofs>(std::integral_constant<int, kDofs>, std::size_t from) HWY_ATTR {
        take_out<kDofs>(plan, link, i, from, at, figure, damping, by_effort, newton, load, concave, gain);
      };
      const int together = together_of(link);
      if (together == 3) {
        out(std::integral_constant<int, 3>(), first);
      } else if (together == 2) {
        out(std::integral_constant<int, 2>(), first);
      } else {
        for (auto j = static_cast<std::size_t>(link.dofs); j-- > 0;) out(std::integral_constant<int, 1>(), first + j);
      }
      if (link.parent >= 0)
        load.hand_down(figure.placed(static_cast<int>(i)).centre - figure.placed(link.parent).centre, newton,
                       this->load(link.parent));
    }
    if (!ties_.empty()) concave = concave - bring_in_ties(plan, figure, gain);
    return (concave <= T(0.0)) & (concave >= T(0.0));
  }

  // No joint is stopped by its bound.
  void let_go() {
    for (T& stopped : stopped_) stopped = T(0.0);
  }

  // From the roots to the leaves: each joint's share of the step, kept inside its bounds, so that those below it make
  // up for what it can not do. True where a bound stopped one: after another factor() those above it make up for it
  // too.
  bool step(const Plan& plan, const Steps<T>& at, const Kinematics<T>& figure, const T& most_turn, Steps<T>& step) {
    bool stopped = false;
    for (std::size_t i = 0; i < plan.links.size(); ++i) {
      const Link& link = plan.links[i];
      Wrench<T>& m = motions_[i];
      if (link.kind == LinkKind::floating) {
        T* to = step.more.data() + link.more;
        to[0] = m.shift.x, to[1] = m.shift.y, to[2] = m.shift.z;
        to[3] = m.turn.x, to[4] = m.turn.y, to[5] = m.turn.z;
        continue;
      }
      carry(link, i, figure);
      const auto first = static_cast<std::size_t>(link.dof);
      const auto go = [&]<int kDofs>(std::integral_constant<int, kDofs>, std::size_t from)
                          HWY_ATTR { stopped |= move_joint<kDofs>(plan, link, i, from, at, figure, most_turn, step); };
      const int together = together_of(link);
      if (together == 3) {
        go(std::integral_constant<int, 3>(), first);
      } else if (together == 2) {
        go(std::integral_constant<int, 2>(), first);
      } else {
        for (std::size_t j = 0; j < static_cast<std::size_t>(link.dofs); ++j)
          go(std::integral_constant<int, 1>(), first + j);
      }
    }
    return stopped;
  }

 private:
  static constexpr double kShort = 1e-12;  // rad or m

  struct Column {
    V3<T> turn, shift;  // the load's matrix times the axis
    T inverse, slope;   // of the pivot (0: pinned); along the axis
    T before[2];        // along the axes of the joint's degrees of freedom before this one, where they go together
  };
  struct Tie {
    T weight;
    std::size_t begin, end;  // parts
  };
  struct Part {
    int link;
    Wrench<T> row;
  };

  // One alone waits for each number, eight fill the processor (and its registers) as they are.
  HWY_INLINE static int together_of(const Link& link) {
    return lanes_of<T>() == 1 || link.kind == LinkKind::limb ? link.dofs : 1;
  }

  HWY_INLINE static T effort(const Plan& plan, std::size_t dof, bool by_effort) {
    return T(by_effort ? plan.dofs[dof].effort : 1.0);
  }

  HWY_INLINE void factor_root(const Plan& plan, const Link& link, const T& damping, bool by_effort, const T& newton,
                              T& concave, Load<T>& load, RootFactor<T>& root) {
    T diagonal[6];
    for (int k = 0; k < 6; ++k) {
      const std::size_t dof = link.first_dof() + static_cast<std::size_t>(k);
      diagonal[k] = damping * effort(plan, dof, by_effort);
      if (plan.sprung()) diagonal[k] = diagonal[k] + T(plan.stiffness[dof]);
    }
    if (plan.sprung()) {
      const T* s = &spring_slopes_[static_cast<std::size_t>(link.dof)];
      load.slope += {{s[3], s[4], s[5]}, {s[0], s[1], s[2]}};
    }
    if (!link.pinned) concave = concave + root.factor(load, diagonal, newton);
  }

  HWY_INLINE Wrench<T> root_motion(const Plan&, const Link& link, std::size_t i, const Wrench<T>& slope, T& gain) {
    if (!link.pinned) return roots_[i].solve(slope, gain);
    Wrench<T> none;
    none.clear();
    return none;
  }

  // The degrees of freedom of one joint, the last first: all of them look at the same load, so that they wait for each
  // other in a few numbers only.
  template <int kDofs>
  HWY_INLINE void take_out(const Plan& plan, const Link& link, std::size_t i, std::size_t first, const Steps<T>& at,
                           const Kinematics<T>& figure, const T& damping, bool by_effort, const T& newton,
                           Load<T>& load, T& concave, T& gain) {
    const T zero(0.0), one(1.0);
    const bool slides = kDofs == 1 && plan.dofs[first].kind == DofKind::along_axis;
    V3<T> u[kDofs], w[kDofs];
    T s[kDofs][kDofs], slope[kDofs];
    POSED_UNROLL
    for (std::size_t k = 0; k < kDofs; ++k) {
      const V3<T>& axis = figure.axis(first + k);
      if (slides) {
        load.times_shift(axis, newton, u[k], w[k]);
        s[k][k] = dot(w[k], axis);
        slope[k] = dot(load.slope.shift, axis);
      } else {
        load.times_turn(axis, newton, u[k], w[k]);
        POSED_UNROLL
        for (std::size_t m = 0; m <= k; ++m) s[m][k] = dot(u[k], figure.axis(first + m));
        slope[k] = dot(load.slope.turn, axis);
      }
      s[k][k] = s[k][k] + damping * effort(plan, first + k, by_effort);
      if (plan.sprung()) {
        if (link.kind != LinkKind::limb) s[k][k] = s[k][k] + T(plan.stiffness[first + k]);
        slope[k] = slope[k] + spring_slopes_[first + k];
      }
    }
    if constexpr (kDofs == 3) {
      if (link.kind == LinkKind::limb) {
        // Its steps are not turns one after the other, and an edge that it is pressed against bends its way.
        const Swinging<T>& limb = figure.swinging(i);
        const V3<T> torque = load.slope.turn * newton;
        if (plan.sprung()) add_spring_of_limb(T(plan.stiffness[first]), figure, first, s);
        const T pressed = select(limb.on_edge > zero, least(slope[0], zero), zero) * newton;
        s[0][0] = s[0][0] + dot(torque, limb.bend_out);
        s[0][1] = s[0][1] + dot(torque, limb.bend_both);
        s[1][1] = s[1][1] + dot(torque, limb.bend_along) - pressed * limb.curvature;
      }
    }
    POSED_UNROLL
    for (std::size_t r = 0; r < kDofs; ++r) {
      const std::size_t k = kDofs - 1 - r;
      const Mask<T> pinned = is_pinned(plan, link, i, first + k, at, figure, slope[0], slope[k]);
      const Mask<T> stopped = stopped_[first + k] > zero;
      concave = concave + select((s[k][k] > zero) | pinned | stopped, zero, one);
      const T inverse = select(pinned | stopped, zero, one / s[k][k]);
      T share = slope[k] * inverse, gained = slope[k] * share;
      if (any(stopped)) {
        const T& stop = stops_[first + k];
        share = select(stopped, -stop, share);
        gained = select(stopped, -(slope[k] + slope[k] + s[k][k] * stop) * stop, gained);
      }
      gain = gain + gained;
      POSED_UNROLL
      for (std::size_t m = 0; m < k; ++m) {
        const T part = s[m][k] * inverse;
        slope[m] = slope[m] - s[m][k] * share;
        POSED_UNROLL
        for (std::size_t n = 0; n <= m; ++n) s[n][m] = s[n][m] - part * s[n][k];
        u[m] -= u[k] * part;
        w[m] -= w[k] * part;
      }
      load.take_out(u[k], w[k], inverse, share);
      Column& column = columns_[first + k];
      column.turn = u[k], column.shift = w[k], column.inverse = inverse, column.slope = slope[k];
      POSED_UNROLL
      for (std::size_t m = 0; m < k; ++m) column.before[m] = s[m][k];
    }
  }

  // The degrees of freedom of one joint, the first first. True where a bound stopped one.
  template <int kDofs>
  HWY_INLINE bool move_joint(const Plan& plan, const Link& link, std::size_t i, std::size_t first, const Steps<T>& at,
                             const Kinematics<T>& figure, const T& most_turn, Steps<T>& step) {
    Wrench<T>& m = motions_[i];
    T slope[kDofs];
    POSED_UNROLL
    for (std::size_t k = 0; k < kDofs; ++k) {
      const Column& c = columns_[first + k];
      slope[k] = c.slope + dot(Wrench<T>{c.turn, c.shift}, m);
    }
    bool stopped = false;
    POSED_UNROLL
    for (std::size_t k = 0; k < kDofs; ++k) {
      const std::size_t j = first + k;
      const T free = -slope[k] * columns_[j].inverse;
      const T share = select(stopped_[j] > T(0.0), stops_[j], free);
      const T wish = most(least(share, most_turn), -most_turn);
      T x = most(least(wish, T(plan.most[j]) - at.turns[j]), T(plan.least[j]) - at.turns[j]);
      if (link.kind == LinkKind::limb) x = figure.swinging(i).within(static_cast<int>(k), x);
      const Mask<T> falls_short = magnitude(wish - x) > T(kShort);
      if (any(falls_short)) {
        stopped = true;
        stops_[j] = select(falls_short, x, stops_[j]);
        stopped_[j] = select(falls_short, T(1.0), stopped_[j]);
      }
      step.turns[j] = x;
      POSED_UNROLL
      for (std::size_t l = k + 1; l < kDofs; ++l) slope[l] = slope[l] + columns_[first + l].before[k] * x;
      move(plan.dofs[j], figure.axis(j), x, m);
    }
    return stopped;
  }

  // A spring against a limb's turn: its degrees of freedom are not at right angles.
  static HWY_INLINE void add_spring_of_limb(const T& weight, const Kinematics<T>& figure, std::size_t first,
                                            T (&s)[3][3]) {
    POSED_UNROLL
    for (std::size_t k = 0; k < 3; ++k) {
      POSED_UNROLL
      for (std::size_t m = 0; m <= k; ++m)
        s[m][k] = s[m][k] + weight * dot(figure.axis(first + m), figure.axis(first + k));
    }
  }

  // At a bound, and pushed against it.
  HWY_INLINE static Mask<T> is_pinned(const Plan& plan, const Link& link, std::size_t i, std::size_t j,
                                      const Steps<T>& at, const Kinematics<T>& figure, const T& slope_first,
                                      const T& slope) {
    const T zero(0.0), near(kOnEdge);
    if constexpr (lanes_of<T>() == 1) {
      const bool inside = at.turns[j] < plan.most[j] - near && at.turns[j] > plan.least[j] + near;
      if (inside && link.kind != LinkKind::limb) return false;
    }
    Mask<T> pinned = ((at.turns[j] >= T(plan.most[j]) - near) & (slope < zero)) |
                     ((at.turns[j] <= T(plan.least[j]) + near) & (slope > zero));
    if (link.kind == LinkKind::limb) {
      const Swinging<T>& swinging = figure.swinging(i);
      const auto first = static_cast<std::size_t>(link.dof);
      if (j == first) pinned = pinned | ((swinging.on_edge > zero) & (slope < zero));
      if (j == first + 1) pinned = pinned | swinging.in_corner(slope_first, slope);
    }
    return pinned;
  }

  HWY_INLINE void carry(const Link& link, std::size_t i, const Kinematics<T>& figure) {
    Wrench<T>& m = motions_[i];
    if (link.parent < 0) return m.clear();
    const Wrench<T>& p = motions_[static_cast<std::size_t>(link.parent)];
    m.turn = p.turn;
    m.shift = p.shift + cross(p.turn, figure.placed(static_cast<int>(i)).centre - figure.placed(link.parent).centre);
  }
  // `whole`: of a step, and not of its change by a tie's pull.
  HWY_INLINE T share(std::size_t j, const Wrench<T>& m, bool whole) const {
    const Column& c = columns_[j];
    const T free = -(c.slope + dot(Wrench<T>{c.turn, c.shift}, m)) * c.inverse;
    return whole ? select(stopped_[j] > T(0.0), stops_[j], free) : free;
  }
  HWY_INLINE static void move(const Dof& dof, const V3<T>& axis, const T& x, Wrench<T>& m) {
    if (dof.kind == DofKind::along_axis)
      m.shift += axis * x;
    else
      m.turn += axis * x;
  }

  // The tree's answer to slopes_ alone: what columns_ say of slopes, and motions_. Bounds are not looked at, but for
  // those that pinned a joint.
  void respond(const Plan& plan, const Kinematics<T>& figure) {
    T gain(0.0);
    for (std::size_t i = plan.links.size(); i-- > 0;) {
      const Link& link = plan.links[i];
      Wrench<T> slope = slopes_[i];
      if (link.kind == LinkKind::floating) {
        motions_[i] = root_motion(plan, link, i, slope, gain);
        continue;
      }
      for (int j = link.dof + link.dofs; j-- > link.dof;) {
        const auto k = static_cast<std::size_t>(j);
        Column& c = columns_[k];
        c.slope = dot(plan.dofs[k].kind == DofKind::along_axis ? slope.shift : slope.turn, figure.axis(k));
        const T share = c.slope * c.inverse;
        slope.turn -= c.turn * share;
        slope.shift -= c.shift * share;
      }
      if (link.parent < 0) continue;
      const V3<T> arm = figure.placed(static_cast<int>(i)).centre - figure.placed(link.parent).centre;
      slopes_[static_cast<std::size_t>(link.parent)] += {slope.turn + cross(arm, slope.shift), slope.shift};
    }
    follow(plan, figure, false);
  }

  // From what columns_ say to motions_.
  void follow(const Plan& plan, const Kinematics<T>& figure, bool whole) {
    for (std::size_t i = 0; i < plan.links.size(); ++i) {
      const Link& link = plan.links[i];
      if (link.kind == LinkKind::floating) continue;
      carry(link, i, figure);
      for (int j = link.dof; j < link.dof + link.dofs; ++j) {
        const auto k = static_cast<std::size_t>(j);
        move(plan.dofs[k], figure.axis(k), share(k, motions_[i], whole), motions_[i]);
      }
    }
  }

  // What columns_ and motions_ of roots say: of a tie, or (after the last of them) of the tree by itself.
  void keep_answer(const Plan& plan, std::size_t tie) {
    T* columns = &tie_columns_[tie * columns_.size()];
    for (std::size_t k = 0; k < columns_.size(); ++k) columns[k] = columns_[k].slope;
    Wrench<T>* roots = &tie_roots_[tie * motions_.size()];
    for (std::size_t i = 0; i < plan.links.size(); ++i) {
      if (plan.links[i].kind == LinkKind::floating) roots[i] = motions_[i];
    }
  }
  void sum_answers(const Plan& plan, std::size_t ties) {
    const T* columns = &tie_columns_[ties * columns_.size()];
    for (std::size_t k = 0; k < columns_.size(); ++k) columns_[k].slope = columns[k];
    for (std::size_t a = 0; a < ties; ++a) {
      const T* of_tie = &tie_columns_[a * columns_.size()];
      for (std::size_t k = 0; k < columns_.size(); ++k)
        columns_[k].slope = columns_[k].slope + of_tie[k] * tie_slopes_[a];
    }
    for (std::size_t i = 0; i < plan.links.size(); ++i) {
      if (plan.links[i].kind != LinkKind::floating) continue;
      motions_[i] = tie_roots_[ties * motions_.size() + i];
      for (std::size_t a = 0; a < ties; ++a) motions_[i] += tie_roots_[a * motions_.size() + i] * tie_slopes_[a];
    }
  }

  HWY_INLINE T along(const Tie& tie) const {
    T sum(0.0);
    for (std::size_t p = tie.begin; p < tie.end; ++p)
      sum = sum + dot(parts_[p].row, motions_[static_cast<std::size_t>(parts_[p].link)]);
    return sum;
  }
  HWY_INLINE void pull_at(const Tie& tie, const T& strength) {
    for (std::size_t p = tie.begin; p < tie.end; ++p)
      slopes_[static_cast<std::size_t>(parts_[p].link)] += parts_[p].row * strength;
  }

  // (tree + sum of weight row row') step = -slope: the ties' own pulls y solve (1/weight + row tree^-1 row') y = row x,
  // with x the step of the tree alone; the answer is that step and those of the ties by their pulls. Returns how many
  // directions in which the tree is concave are made convex by ties (Sylvester's law of inertia); takes from `gain`
  // what they hold back.
  T bring_in_ties(const Plan& plan, const Kinematics<T>& figure, T& gain) {
    const std::size_t n = ties_.size();
    keep_answer(plan, n);
    follow(plan, figure, true);
    for (std::size_t a = 0; a < n; ++a) tie_slopes_[a] = along(ties_[a]);
    for (std::size_t b = 0; b < n; ++b) {
      for (Wrench<T>& s : slopes_) s.clear();
      pull_at(ties_[b], T(1.0));
      respond(plan, figure);
      keep_answer(plan, b);
      for (std::size_t a = 0; a < n; ++a) tie_matrix_[a * n + b] = -along(ties_[a]);
      tie_matrix_[b * n + b] = tie_matrix_[b * n + b] + T(1.0) / ties_[b].weight;
    }
    const T mended = solve_ties(n, gain);
    sum_answers(plan, n);
    return mended;
  }

  // L D L', in place. Returns how many pivots are below 0.
  T solve_ties(std::size_t n, T& gain) {
    const T zero(0.0), one(1.0), tiny(1e-30);
    T below = zero;
    const auto m = [&](std::size_t a, std::size_t b) -> T& { return tie_matrix_[a * n + b]; };
    for (std::size_t k = 0; k < n; ++k) {
      const T pivot = m(k, k);
      below = below + select(pivot < zero, one, zero);
      m(k, k) = one / select(magnitude(pivot) > tiny, pivot, tiny);
      gain = gain - tie_slopes_[k] * tie_slopes_[k] * m(k, k);
      for (std::size_t a = k + 1; a < n; ++a) {
        const T l = m(a, k) * m(k, k);
        for (std::size_t b = k + 1; b <= a; ++b) m(a, b) = m(a, b) - l * m(b, k);
        tie_slopes_[a] = tie_slopes_[a] - l * tie_slopes_[k];
      }
    }
    for (std::size_t k = n; k-- > 0;) {
      T sum = tie_slopes_[k];
      for (std::size_t a = k + 1; a < n; ++a) sum = sum - m(a, k) * tie_slopes_[a];
      tie_slopes_[k] = sum * m(k, k);
    }
    return below;
  }

  Memory<Load<T>> loads_;
  Memory<Wrench<T>> slopes_, motions_;
  Memory<RootFactor<T>> roots_;
  Memory<Column> columns_;
  Memory<T> spring_slopes_;
  Memory<T> stops_, stopped_;  // the steps of joints that their bounds stop; 1 where they do
  Memory<Tie> ties_;
  Memory<Part> parts_;
  Memory<T> tie_matrix_, tie_slopes_;
  // One share a tie: its pull's answers in columns_, and those of roots in motions_.
  Memory<T> tie_columns_;
  Memory<Wrench<T>> tie_roots_;
};

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
