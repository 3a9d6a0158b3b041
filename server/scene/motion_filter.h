// Makes a trembling sensor calm, and looks a little ahead: the One-Euro filter (Casiez, Roussel and Vogel, CHI 2012) on
// place and turn, then a bounded linear predictor. Time comes in with each sample; a gap in it begins anew, so that
// nothing is smeared over it. Does not allocate.
#pragma once

#include "common/binding.h"
#include "common/math.h"
#include "common/time.h"

namespace posed {

class MotionFilter {
 public:
  static constexpr Nanoseconds kGap = 100'000'000;  // longer than this without a sample, or back in time
  static constexpr double kMostAhead = 0.1;         // m that a prediction may go beyond the filtered place
  static constexpr double kMostTurnAhead = 0.5;     // rad

  // `t_ns`: when it was measured, on any one clock. The same time twice is the same sample.
  Transform next(const BindingFilter& how, const Transform& raw, Nanoseconds t_ns);

 private:
  bool begun_ = false;
  Nanoseconds t_ns_ = 0;
  Transform filtered_, out_;
  Vec3 slope_{0.0, 0.0, 0.0}, turn_slope_{0.0, 0.0, 0.0};        // m/s and rad/s, as the filter smoothes them
  Vec3 velocity_{0.0, 0.0, 0.0}, turn_velocity_{0.0, 0.0, 0.0};  // of what is filtered, as the predictor does
};

}  // namespace posed
