#include "server/scene/spring_goals.h"

#include <algorithm>

namespace posed {

SpringGoal spring_goal(const SceneGoal& goal, const Transform& world_from_base) {
  SpringGoal spring;
  spring.at = goal.at;
  spring.spring = goal.spring;
  if (joins_figures(goal))
    spring.world_from_base = world_from_base;
  else if (goal.goal.relative_to.kind == GoalBase::Kind::segment)
    spring.base_segment = goal.base_segment;
  spring.weight = goal.goal.weight.value;
  spring.orientation_weight = goal.goal.weight.orientation.value_or(goal.goal.weight.value);
  spring.priority = goal.goal.priority;
  spring.tolerance = goal.goal.tolerance;
  follow_sensors(goal, spring);
  return spring;
}

void follow_sensors(const SceneGoal& goal, SpringGoal& spring) {
  spring.enabled = goal.goal.enabled;
  const GoalBase::Kind base = goal.goal.relative_to.kind;
  if (base == GoalBase::Kind::sensor || base == GoalBase::Kind::object) {
    spring.enabled = spring.enabled && goal.world_from_base;
    if (goal.world_from_base) spring.world_from_base = *goal.world_from_base;
  }
  if (goal.live) place_spring(*goal.live, spring.spring);
}

void place_spring(const Transform& place, Spring& spring) {
  if (auto* position = std::get_if<PositionSpring>(&spring)) position->position = place.position;
  if (auto* orientation = std::get_if<OrientationSpring>(&spring)) orientation->rotation = place.rotation;
  if (auto* pose = std::get_if<PoseSpring>(&spring)) *pose = {place.position, place.rotation};
}

SpringGoal joint_spring(const SceneBinding& binding, const BodyTree& tree) {
  SpringGoal spring;
  const auto size = static_cast<std::size_t>(q_size(tree.joint(binding.joint).type));
  spring.spring = PostureSpring{{binding.joint}, std::vector<double>(size)};
  spring.priority = kJointPriority;
  follow_sensor(binding, spring);
  return spring;
}

void follow_sensor(const SceneBinding& binding, SpringGoal& spring) {
  spring.enabled = binding.moves_joint;
  auto& values = std::get<PostureSpring>(spring.spring).values;
  std::copy_n(binding.share.begin(), values.size(), values.begin());
}

std::vector<SpringGoal> pin_goals(const SceneFigure& figure) {
  std::vector<SpringGoal> goals;
  for (const auto& [segment, pin] : figure.entry.pins) {
    SpringGoal& goal = goals.emplace_back();
    const int i = *figure.tree->find_segment(segment);
    goal.at = {i, figure.tree->segment(i).touch_point};
    goal.priority = kPinPriority;
    if (pin.hold == Pin::Hold::position)
      goal.spring = PositionSpring{*pin.position};
    else if (pin.hold == Pin::Hold::orientation)
      goal.spring = OrientationSpring{*pin.rotation};
    else
      goal.spring = PoseSpring{*pin.position, *pin.rotation};
  }
  return goals;
}

}  // namespace posed
