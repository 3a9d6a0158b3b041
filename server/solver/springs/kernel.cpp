#include "server/solver/springs/kernel.h"

#include <algorithm>

#include "server/solver/springs/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/solver/springs/kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include "server/solver/springs/descent-inl.h"

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

// A lane type is so many doubles side by side.
template <class T>
void put_in(const std::vector<double>& from, int lane, Memory<T>& to) {
  double* values = reinterpret_cast<double*>(to.data());
  for (std::size_t j = 0; j < from.size(); ++j) values[j * lanes_of<T>() + static_cast<std::size_t>(lane)] = from[j];
}
template <class T>
void put_in(const State& from, int lane, Steps<T>& to) {
  put_in(from.turns, lane, to.turns);
  put_in(from.more, lane, to.more);
}
template <class T>
void take_out(const Steps<T>& from, int i, State& to) {
  for (std::size_t j = 0; j < to.turns.size(); ++j) to.turns[j] = lane(from.turns[j], i);
  for (std::size_t j = 0; j < to.more.size(); ++j) to.more[j] = lane(from.more[j], i);
}

class KernelHere final : public Kernel {
 public:
  void prepare(const Plan& plan) override {
    std::size_t ties = 0, parts = 0;
    for (const Term& term : plan.terms) {
      if (term.kind == TermKind::balance) {
        ties += 2;
        parts += 2 * (plan.links.size() + static_cast<std::size_t>(term.supports));
      } else if (term.base >= 0) {
        ties += 3;
        parts += 6;
      }
    }
    alone_.resize(plan, ties, parts);
    eight_.resize(plan, ties, parts);
  }

  Answer descend(const Plan& plan, const Tuning& tuning, const std::function<bool()>& should_stop,
                 State& state) override {
    put_in(state, 0, alone_.start());
    const Answer answer = run(plan, tuning, should_stop, alone_, [] { return false; });
    take_out(alone_.reached(), 0, state);
    return answer;
  }

  Answer search(const Plan& plan, const Tuning& tuning, const std::function<bool()>& should_stop,
                std::span<State> states) override {
    static_assert(kLanes == kStarts);
    for (int i = 0; i < kLanes; ++i) put_in(states[static_cast<std::size_t>(i)], i, eight_.start());
    Answer answer = run(plan, tuning, should_stop, eight_, [&] { return any(eight_.cost() <= Lanes(tuning.enough)); });
    int best = 0;
    for (int i = 1; i < kLanes; ++i) {
      if (lane(eight_.cost(), i) < lane(eight_.cost(), best)) best = i;
    }
    take_out(eight_.reached(), best, states[0]);
    answer.cost = lane(eight_.cost(), best);
    return answer;
  }

  const char* instruction_set() const override { return hwy::TargetName(HWY_TARGET); }

 private:
  template <class T, class Enough>
  Answer run(const Plan& plan, const Tuning& tuning, const std::function<bool()>& should_stop, Descent<T>& descent,
             Enough enough) {
    Answer answer;
    if (tuning.align) descent.align(plan);
    descent.begin(tuning);
    while (true) {
      ++answer.iterations;
      if (!descent.iterate(plan)) answer.at_rest = true;
      if (answer.iterations == 1 && lane(descent.cost(), 0) > tuning.most_start) {
        answer.too_far = true;
        break;
      }
      if (answer.at_rest || enough() || answer.iterations >= tuning.iterations) break;
      if (should_stop && should_stop()) {
        answer.stopped = true;
        break;
      }
    }
    answer.cost = lane(descent.cost(), 0);
    return answer;
  }

  Descent<double> alone_;
  Descent<Lanes> eight_;
};

std::unique_ptr<Kernel> make_kernel_here() {
  return std::make_unique<KernelHere>();
}

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace posed::springs {

HWY_EXPORT(make_kernel_here);

std::unique_ptr<Kernel> make_kernel() {
  return HWY_DYNAMIC_DISPATCH(make_kernel_here)();
}

}  // namespace posed::springs
#endif
