#include "server/scene/errors.h"
#include "server/scene/goal_resolve.h"
#include "server/scene/place.h"
#include "server/scene/scene.h"

namespace posed {

Result<SceneCamera> Scene::make_camera(Camera camera) const {
  if (const Status placed = settle_place(camera.base_from_camera); !placed) return placed.error();
  if (!(camera.fov_y > 0.0 && camera.fov_y < M_PI))
    return Error{"out_of_range", "the field of view is out of range", "/fov_y", "above 0 and below pi, in radians"};

  SceneCamera made;
  GoalBase& base = camera.relative_to;
  if (base.kind == GoalBase::Kind::segment) {
    const Result<const SceneFigure*> figure = find_figure(base.figure);
    if (!figure) return below("/relative_to", figure.error());
    base.figure = (*figure)->entry.id;
    const Result<AttachedPoint> place_of = (*figure)->tree->attach({base.segment, {}, ""});
    if (!place_of) return below("/relative_to/segment", place_of.error());
    made.base_segment = place_of->segment;
  } else if (base.kind == GoalBase::Kind::sensor) {
    const Result<SensorName> sensor = read_sensor(base.sensor);
    if (!sensor) return below("/relative_to", sensor.error());
    made.base_sensor = *sensor;
  } else if (base.kind == GoalBase::Kind::object) {
    const auto object = objects_.find(base.object);
    if (object == objects_.end()) return unknown("object", base.object, keys(objects_), "/relative_to/object");
    made.world_from_base = object->second.world_from_object();
  }
  made.camera = std::move(camera);
  made.revision = 1;
  return made;
}

Result<Edited> Scene::set_camera(const CameraEdit& edit, IfRevision if_revision) {
  if (const Status checked = check_id(edit.id); !checked) return checked.error();
  if (const auto error = stale(cameras_, edit.id, if_revision)) return *error;
  const auto before = cameras_.find(edit.id);
  Camera camera;
  if (before != cameras_.end()) camera = before->second.camera;
  camera.id = edit.id;
  edit.position.apply(camera.base_from_camera.position);
  edit.rotation.apply(camera.base_from_camera.rotation, quat_identity());
  edit.relative_to.apply(camera.relative_to);
  edit.fov_y.apply(camera.fov_y, kDefaultFovY);
  edit.label.apply(camera.label);
  edit.user.apply(camera.user);
  Result<SceneCamera> made = make_camera(std::move(camera));
  if (!made) return made.error();
  if (made->camera.relative_to.kind != GoalBase::Kind::world) {
    for (const auto& [id, binding] : bindings_) {
      if (binding.binding.to.camera == edit.id)
        return Error{"invalid_params", "binding " + id + " moves the camera in the world", "/relative_to",
                     "remove the binding first"};
    }
  }
  made->revision = next_revision(&Change::cameras, cameras_, edit.id);
  if (before != cameras_.end()) {
    made->live = before->second.live;
    if (made->base_sensor.station != 0 && made->base_sensor == before->second.base_sensor)
      made->world_from_base = before->second.world_from_base;
  }
  const Revision revision = made->revision;
  keep_camera(edit.id);
  cameras_.insert_or_assign(edit.id, std::move(*made));
  return Edited{edit.id, count(), revision};
}

// What a new figure under the id makes of cameras relative to it. Errors: a segment is gone.
Result<std::map<std::string, SceneCamera>> Scene::refit_cameras(const std::string& figure,
                                                                const SceneFigure& next) const {
  std::map<std::string, SceneCamera> fitted;
  for (const auto& [id, camera] : cameras_) {
    const GoalBase& base = camera.camera.relative_to;
    if (base.kind != GoalBase::Kind::segment || base.figure != figure) continue;
    const Result<AttachedPoint> place = next.tree->attach({base.segment, {}, ""});
    if (!place) {
      return Error{place.error().code, "camera " + id + " does not fit the new figure: " + place.error().message, "/id",
                   "set its relative_to first"};
    }
    fitted.emplace(id, camera).first->second.base_segment = place->segment;
  }
  return fitted;
}

Result<Edited> Scene::remove_camera(const std::string& id, IfRevision if_revision) {
  if (!cameras_.contains(id)) return unknown("camera", id, keys(cameras_), "/id");
  if (const auto error = stale(cameras_, id, if_revision)) return *error;
  drop_bindings([&](const BindingTarget& to) { return to.camera == id; });
  keep_camera(id);
  cameras_.erase(id);
  return Edited{id, count(), 0};
}

}  // namespace posed
