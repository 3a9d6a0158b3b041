#include "server/scene/errors.h"
#include "server/scene/goal_resolve.h"
#include "server/scene/place.h"
#include "server/scene/scene.h"
#include "server/solver/figure_check.h"

namespace posed {
namespace {

constexpr std::size_t kMostNamed = 8;  // in a message

bool sane(const Shape& shape) {
  const bool sizes = shape.kind == Shape::Kind::capsule || (shape.b.x >= 0.0 && shape.b.y >= 0.0 && shape.b.z >= 0.0);
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(shape.a[i]) <= kMaxLength && std::abs(shape.b[i]) <= kMaxLength)) return false;
  }
  return sizes && shape.radius >= 0.0 && shape.radius <= kMaxLength;
}

}  // namespace

Result<SceneObject> Scene::make_object(Object object) {
  if (const Status placed = settle_place(object.world_from_object); !placed) return placed.error();
  if (object.shapes.size() > kMaxShapes)
    return Error{"out_of_range", "the object has more than 64 shapes", "/shape", "draw it with fewer"};
  for (std::size_t i = 0; i < object.shapes.size(); ++i) {
    if (sane(object.shapes[i])) continue;
    return Error{"out_of_range", "a number of a shape is too large or negative", "/shape/" + std::to_string(i),
                 "sizes are 0 or more, all numbers within 10000 m"};
  }
  SceneObject made;
  made.object = std::move(object);
  made.revision = 1;
  return made;
}

Result<Edited> Scene::set_object(const ObjectEdit& edit, IfRevision if_revision) {
  if (const Status checked = check_id(edit.id); !checked) return checked.error();
  if (const auto error = stale(objects_, edit.id, if_revision)) return *error;
  const auto before = objects_.find(edit.id);
  Object object;
  if (before != objects_.end()) object = before->second.object;
  object.id = edit.id;
  edit.position.apply(object.world_from_object.position);
  edit.rotation.apply(object.world_from_object.rotation, quat_identity());
  edit.shapes.apply(object.shapes);
  edit.label.apply(object.label);
  edit.user.apply(object.user);
  Result<SceneObject> made = make_object(std::move(object));
  if (!made) return made.error();
  made->revision = next_revision(&Change::objects, objects_, edit.id);
  if (before != objects_.end()) made->live = before->second.live;
  const Revision revision = made->revision;
  keep_object(edit.id);
  carry(objects_.insert_or_assign(edit.id, std::move(*made)).first->second);
  return Edited{edit.id, count(), revision};
}

Result<Edited> Scene::remove_object(const std::string& id, IfRevision if_revision) {
  if (!objects_.contains(id)) return unknown("object", id, keys(objects_), "/id");
  if (const auto error = stale(objects_, id, if_revision)) return *error;
  std::string riders;
  std::size_t hanging = 0;
  for (const auto& [goal_id, goal] : goals_) {
    if (!goal.rides_on(id)) continue;
    if (++hanging <= kMostNamed) riders += (riders.empty() ? "" : ", ") + goal_id;
  }
  for (const auto& [camera_id, camera] : cameras_) {
    if (!camera.rides_on(id)) continue;
    if (++hanging <= kMostNamed) riders += (riders.empty() ? "" : ", ") + ("camera " + camera_id);
  }
  if (hanging > kMostNamed) riders += " and " + std::to_string(hanging - kMostNamed) + " more";
  if (hanging > 0)
    return Error{"in_use", "other things are relative to object " + id + ": " + riders, "/id",
                 "remove them or set their relative_to first"};
  drop_bindings([&](const BindingTarget& to) { return to.object == id; });
  keep_object(id);
  objects_.erase(id);
  return Edited{id, count(), 0};
}

}  // namespace posed
