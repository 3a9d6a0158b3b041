// Joint values of one figure to the state of a solve and back, with memory of their own.
#pragma once

#include "server/solver/springs/joint_angles.h"

namespace posed::test {

inline void read_q(const BodyTree& tree, int figure, const springs::Plan& plan, std::span<const double> q,
                   springs::State& state) {
  springs::JointAngles angles;
  angles.resize(plan);
  angles.read(tree, figure, plan, q, state);
}

inline void write_q(const BodyTree& tree, int figure, const springs::Plan& plan, const springs::State& state,
                    std::span<double> q) {
  springs::JointAngles angles;
  angles.resize(plan);
  angles.write(tree, figure, plan, state, q);
}

}  // namespace posed::test
