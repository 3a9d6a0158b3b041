// Live motion: what sensors move, and what rides on that. No edit; nothing here allocates.
#include "server/scene/scene.h"

namespace posed {
namespace {

bool differ(const Transform& a, const Transform& b) {
  return a.position != b.position || a.rotation != b.rotation;
}

}  // namespace

// Where the target of a binding stands now.
Transform Scene::target_of(const BindingTarget& to) const {
  if (!to.object.empty()) return objects_.find(to.object)->second.world_from_object();
  return {goals_.find(to.goal)->second.target(), quat_identity()};
}

// True where it has moved.
bool Scene::place_target(const BindingTarget& to, const Axes& axes, const Transform& wanted) {
  const auto blend = [&axes](Vec3 position, const Vec3& towards) {
    if (axes.x) position.x = towards.x;
    if (axes.y) position.y = towards.y;
    if (axes.z) position.z = towards.z;
    return position;
  };
  if (!to.object.empty()) {
    SceneObject& object = objects_.find(to.object)->second;
    Transform placed = object.object.world_from_object;
    placed.position = blend(placed.position, wanted.position);
    if (axes.rotation) placed.rotation = wanted.rotation;
    const bool moved = !object.live || differ(*object.live, placed);
    object.live = placed;
    if (moved) carry(object);
    return moved;
  }
  SceneGoal& goal = goals_.find(to.goal)->second;
  const Vec3* placed = position_of(goal.goal.payload);
  if (!placed) return false;
  const Vec3 target = blend(*placed, wanted.position);
  const bool moved = !goal.live || *goal.live != target;
  goal.live = target;
  return moved;
}

// Takes along the goals that are relative to it. True where there are any.
bool Scene::carry(const SceneObject& object) {
  bool any = false;
  for (auto& [id, goal] : goals_) {
    if (!goal.rides_on(object.object.id)) continue;
    goal.world_from_base = object.world_from_object();
    goal.base_moves = object.live.has_value();
    any = true;
  }
  return any;
}

bool Scene::follow(const Frame& frame) {
  bool moved = false;
  for (auto& [id, goal] : goals_) {
    if (goal.base_sensor.station == 0 || goal.base_sensor.device != frame.device) continue;
    for (const Sample& sample : frame.samples) {
      if (sample.station != goal.base_sensor.station) continue;
      const Transform base{sample.position, sample.rotation};
      moved = moved || !goal.world_from_base || differ(*goal.world_from_base, base);
      goal.world_from_base = base;
      goal.base_moves = true;
    }
  }
  for (auto& [id, b] : bindings_) {
    if (b.sensor.device != frame.device) continue;
    for (const Sample& sample : frame.samples) {
      if (sample.station != b.sensor.station) continue;
      Transform wanted{sample.position * b.binding.scale, sample.rotation};
      if (b.binding.mode == Binding::Mode::relative) {
        if (!b.anchor) b.anchor = SceneBinding::Anchor{{sample.position, sample.rotation}, target_of(b.binding.to)};
        const SceneBinding::Anchor& from = *b.anchor;
        wanted.position = from.target.position + b.binding.scale * (sample.position - from.sensor.position);
        wanted.rotation = glm::normalize(sample.rotation * glm::conjugate(from.sensor.rotation) * from.target.rotation);
      }
      const bool placed = place_target(b.binding.to, b.binding.axes, wanted);
      moved = moved || placed;
    }
  }
  return moved;
}

// The goal or object stays where the sensor left it: letting go of a thing does not throw it back.
void Scene::let_go(const BindingTarget& target) {
  if (!target.object.empty()) {
    SceneObject& object = objects_.at(target.object);
    if (!object.live) return;
    keep_object(target.object);
    object.object.world_from_object = *object.live;
    object.live.reset();
    ++object.revision;
    carry(object);
    return;
  }
  SceneGoal& goal = goals_.at(target.goal);
  if (!goal.live) return;
  keep_goal(target.goal);
  if (Vec3* position = position_of(goal.goal.payload)) *position = *goal.live;
  if (auto* spring = std::get_if<PositionSpring>(&goal.spring)) spring->position = *goal.live;
  if (auto* spring = std::get_if<PoseSpring>(&goal.spring)) spring->position = *goal.live;
  goal.live.reset();
  ++goal.revision;
}

}  // namespace posed
