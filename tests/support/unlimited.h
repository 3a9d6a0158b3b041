// What the reach tree's solver is given, for the spring solver: the paper knows no limits.
#pragma once

#include "server/solver/spring_goal.h"
#include "tests/support/figures.h"
#include "tests/support/scene_file.h"

namespace posed::test {

inline SceneFile without_limits(SceneFile scene) {
  FigureDocument document = scene.tree->document();
  for (Segment& segment : document.segments) {
    // A universal joint bends as a ball there.
    if (segment.joint.type == JointType::universal) segment.joint.type = JointType::ball, segment.joint.axes.clear();
    segment.joint.limits.clear();
    segment.joint.swing.reset();
    segment.joint.twist.reset();
  }
  scene.tree = build(document);
  return scene;
}

inline std::vector<SpringGoal> as_springs(const std::vector<ReachGoal>& goals) {
  std::vector<SpringGoal> out;
  for (const ReachGoal& goal : goals) {
    SpringGoal spring;
    spring.at = {goal.segment, goal.point};
    spring.spring = PositionSpring{goal.target};
    spring.weight = goal.weight, spring.tolerance = goal.tolerance, spring.enabled = goal.enabled;
    out.push_back(spring);
  }
  return out;
}

}  // namespace posed::test
