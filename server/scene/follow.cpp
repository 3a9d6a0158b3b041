// Live motion: what sensors move, and what rides on that. No edit; nothing here allocates.
#include "server/scene/scene.h"
#include "server/scene/spring_goals.h"
#include "server/solver/kinematics.h"

namespace posed {
namespace {

bool differ(const Transform& a, const Transform& b) {
  return a.position != b.position || a.rotation != b.rotation;
}

bool move(std::optional<Transform>& live, Transform to) {
  if (live) to.rotation = same_sign(live->rotation, to.rotation);
  const bool moved = !live || differ(*live, to);
  live = to;
  return moved;
}

// How the joint's frame lies in the world before it turns.
Quat world_from_joint(const SceneFigure& figure, int joint) {
  const BodyTree& tree = *figure.tree;
  const Quat own = tree.joint(joint).parent_from_joint.rotation;
  return tree.parent(joint) < 0 ? own : world_rotation(tree, tree.parent(joint), figure.q) * own;
}

}  // namespace

// Where the target of a binding stands now; of a joint how its segment lies in the world.
Transform Scene::target_of(const SceneBinding& binding) const {
  const BindingTarget& to = binding.binding.to;
  if (!to.goal.empty()) return goals_.find(to.goal)->second.place();
  if (!to.object.empty()) return objects_.find(to.object)->second.world_from_object();
  if (!to.camera.empty()) {
    const SceneCamera& camera = cameras_.find(to.camera)->second;
    return camera.live.value_or(camera.camera.base_from_camera);
  }
  const SceneFigure& figure = figures_.find(to.figure)->second;
  return {kZero, world_rotation(*figure.tree, binding.joint, figure.q)};
}

void Scene::place_target(SceneBinding& binding, const Transform& wanted, Followed& followed) {
  const BindingTarget& to = binding.binding.to;
  const Axes& axes = *binding.binding.axes;
  if (!to.goal.empty()) {
    SceneGoal& goal = goals_.find(to.goal)->second;
    followed.pose = move(goal.live, on_axes(axes, place_of(goal.goal.payload), wanted)) || followed.pose;
  } else if (!to.object.empty()) {
    SceneObject& object = objects_.find(to.object)->second;
    if (!move(object.live, on_axes(axes, object.object.world_from_object, wanted))) return;
    followed.pose = true;
    followed.cameras = carry(object).cameras || followed.cameras;
  } else if (!to.camera.empty()) {
    SceneCamera& camera = cameras_.find(to.camera)->second;
    followed.cameras = move(camera.live, on_axes(axes, camera.camera.base_from_camera, wanted)) || followed.cameras;
  } else {
    const SceneFigure& figure = figures_.find(to.figure)->second;
    const Joint& joint = figure.tree->joint(binding.joint);
    if (!binding.rest) binding.rest = target_of(binding);
    const Quat turn =
        glm::conjugate(world_from_joint(figure, binding.joint)) * on_axes(axes, *binding.rest, wanted).rotation;
    std::array<double, 4> share{};
    if (joint.type == JointType::hinge) {
      share[0] = twist_angle(turn, joint.axes[0]);
    } else {
      const auto before =
          std::span<const double>(figure.q).subspan(static_cast<std::size_t>(figure.tree->q_at(binding.joint)), 4);
      share = xyzw(same_sign(quat_from_xyzw(before), glm::normalize(turn)));
    }
    followed.pose = followed.pose || !binding.moves_joint || share != binding.share;
    binding.share = share;
    binding.moves_joint = true;
  }
}

// Takes along what is relative to it.
Scene::Followed Scene::carry(const SceneObject& object) {
  Followed followed;
  for (auto& [id, goal] : goals_) {
    if (!goal.rides_on(object.object.id)) continue;
    goal.world_from_base = object.world_from_object();
    goal.base_moves = object.live.has_value();
    followed.pose = true;
  }
  for (auto& [id, camera] : cameras_) {
    if (!camera.rides_on(object.object.id)) continue;
    camera.world_from_base = object.world_from_object();
    followed.cameras = true;
  }
  return followed;
}

// Where the document has the target; of a joint where it was when the binding began.
Transform Scene::home_of(const SceneBinding& binding) const {
  const BindingTarget& to = binding.binding.to;
  if (!to.goal.empty()) return place_of(goals_.find(to.goal)->second.goal.payload);
  if (!to.object.empty()) return objects_.find(to.object)->second.object.world_from_object;
  if (!to.camera.empty()) return cameras_.find(to.camera)->second.camera.base_from_camera;
  return binding.rest.value_or(target_of(binding));
}

void Scene::press(SceneBinding& binding, ButtonAction::Do act, const Transform& world_from_sensor, Followed& followed) {
  switch (act) {
    case ButtonAction::Do::recenter:
      binding.anchor = MotionAnchor{world_from_sensor, home_of(binding)};
      return place_target(binding, binding.anchor->world_from_target, followed);
    case ButtonAction::Do::toggle:
      binding.paused = !binding.paused;
      return;
    case ButtonAction::Do::save:
      followed.saving.push_back(binding.binding.id);
      return;
  }
}

// The filter hears the sensor whether the clutch is held or not.
void Scene::follow(SceneBinding& binding, const Sample& sample, Nanoseconds t_ns, Followed& followed) {
  const Binding& b = binding.binding;
  Transform world_from_sensor{sample.position, sample.rotation};
  if (b.filter)
    world_from_sensor =
        binding.filter.next(*b.filter, world_from_sensor, sample.device_t_ns ? sample.device_t_ns : t_ns);
  const std::uint32_t pressed = sample.buttons & ~binding.held;
  binding.held = sample.buttons;
  for (const ButtonAction& action : b.buttons) {
    if (pressed >> action.button & 1u) press(binding, action.act, world_from_sensor, followed);
  }
  const bool clutched = !b.clutch || (sample.buttons >> b.clutch->button & 1u) != 0;
  if (!clutched || binding.paused) return binding.anchor.reset();
  if (b.mode == Binding::Mode::absolute) return place_target(binding, absolute_motion(b, world_from_sensor), followed);
  if (!binding.anchor) binding.anchor = MotionAnchor{world_from_sensor, target_of(binding)};
  place_target(binding, relative_motion(b, *binding.anchor, world_from_sensor), followed);
}

Scene::Followed Scene::follow(const Frame& frame) {
  Followed followed;
  const auto sample_of = [&frame](const SensorName& sensor) -> const Sample* {
    if (sensor.station == 0 || sensor.device != frame.device) return nullptr;
    for (const Sample& sample : frame.samples) {
      if (sample.station == sensor.station) return &sample;
    }
    return nullptr;
  };
  for (auto& [id, goal] : goals_) {
    const Sample* sample = sample_of(goal.base_sensor);
    if (!sample) continue;
    followed.pose = move(goal.world_from_base, {sample->position, sample->rotation}) || followed.pose;
    goal.base_moves = true;
  }
  for (auto& [id, camera] : cameras_) {
    if (const Sample* sample = sample_of(camera.base_sensor))
      followed.cameras = move(camera.world_from_base, {sample->position, sample->rotation}) || followed.cameras;
  }
  for (auto& [id, binding] : bindings_) {
    if (const Sample* sample = sample_of(binding.sensor)) follow(binding, *sample, frame.t_ns, followed);
  }
  return followed;
}

// What was bound stays where the sensor left it: letting go of a thing does not throw it back. Of a joint that is what
// the figure's q says already.
void Scene::let_go(const SceneBinding& binding) {
  const BindingTarget& to = binding.binding.to;
  if (!to.goal.empty()) {
    SceneGoal& goal = goals_.at(to.goal);
    if (!goal.live) return;
    keep_goal(to.goal);
    place_payload(*goal.live, goal.goal.payload);
    place_spring(goal.place(), goal.spring);
    goal.live.reset();
    ++goal.revision;
  } else if (!to.object.empty()) {
    SceneObject& object = objects_.at(to.object);
    if (!object.live) return;
    keep_object(to.object);
    object.object.world_from_object = *object.live;
    object.live.reset();
    ++object.revision;
    carry(object);
  } else if (!to.camera.empty()) {
    SceneCamera& camera = cameras_.at(to.camera);
    if (!camera.live) return;
    keep_camera(to.camera);
    camera.camera.base_from_camera = *camera.live;
    camera.live.reset();
    ++camera.revision;
  }
}

}  // namespace posed
