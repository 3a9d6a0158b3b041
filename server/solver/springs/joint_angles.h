// Joint values of a figure to and from the state of a solve: quaternions to angles and back, all joints in one sweep.
#pragma once

#include <span>
#include <vector>

#include "server/solver/body_tree.h"
#include "server/solver/springs/plan.h"

namespace posed::springs {

// Owns its scratch memory: one a thread.
class JointAngles {
 public:
  // Memory for this plan; after it nothing allocates.
  void resize(const Plan& plan);

  // Joint values of one figure -> its share of the state, whose arrays have their sizes. A quaternion that leaves the
  // axes of its joint comes to near angles; nothing is clamped.
  void read(const BodyTree& tree, int figure, const Plan& plan, std::span<const double> q, State& state);
  // And back. Values of links that are not in the plan stay. Quaternions keep the sign of those in q.
  void write(const BodyTree& tree, int figure, const Plan& plan, const State& state, std::span<double> q);

 private:
  std::vector<double> first_, second_, angles_;  // one a degree of freedom, padded
};

// Turns a ball or limb back towards where it was, until it has turned by no more than `most`, rad. False where there
// was no need.
bool hold_back(const Link& link, const State& from, double most, State& state);

// A turn that is out of its bounds by whole turns is brought home.
double home(const Dof& dof, double turn);

}  // namespace posed::springs
