#include "server/scene/scene.h"

#include "common/names.h"
#include "server/scene/errors.h"

namespace posed {

Scene::Scene(SceneFigure figure) {
  std::string id = figure.entry.id;
  figures_.emplace(std::move(id), std::move(figure));
}

SceneDocument Scene::document() const {
  SceneDocument document;
  for (const auto& [id, figure] : figures_) {
    FigureEntry entry = figure.entry;
    entry.q = figure.q;
    document.figures.emplace(id, std::move(entry));
  }
  for (const auto& [id, goal] : goals_) document.goals.emplace(id, goal.goal);
  for (const auto& [id, object] : objects_) document.objects.emplace(id, object.object);
  for (const auto& [id, binding] : bindings_) document.bindings.emplace(id, binding.binding);
  for (const auto& [id, camera] : cameras_) document.cameras.emplace(id, camera.camera);
  return document;
}

SceneDocument Scene::as_it_stands() const {
  SceneDocument document = this->document();
  for (const auto& [id, goal] : goals_) {
    if (goal.live) place_payload(*goal.live, document.goals.at(id).payload);
  }
  for (const auto& [id, object] : objects_) document.objects.at(id).world_from_object = object.world_from_object();
  for (const auto& [id, camera] : cameras_) {
    if (camera.live) document.cameras.at(id).base_from_camera = *camera.live;
  }
  document.bindings.clear();
  return document;
}

Status Scene::load(const SceneDocument& document) {
  Scene next;
  for (const auto& [id, entry] : document.figures) {
    FigureEntry named = entry;
    named.id = id;
    Result<SceneFigure> figure = check_id(id) ? make_figure(std::move(named)) : check_id(id).error();
    if (!figure) return below("/figures/" + token(id), figure.error());
    next.figures_.emplace(id, std::move(*figure));
  }
  for (const auto& [id, entry] : document.objects) {
    Object named = entry;
    named.id = id;
    Result<SceneObject> object = check_id(id) ? make_object(std::move(named)) : check_id(id).error();
    if (!object) return below("/objects/" + token(id), object.error());
    next.objects_.emplace(id, std::move(*object));
  }
  for (const auto& [id, entry] : document.goals) {
    Goal named = entry;
    named.id = id;
    Result<SceneGoal> goal = check_id(id) ? next.make_goal(std::move(named), next.figures_) : check_id(id).error();
    if (!goal) return below("/goals/" + token(id), goal.error());
    next.goals_.emplace(id, std::move(*goal));
  }
  for (const auto& [id, entry] : document.cameras) {
    Camera named = entry;
    named.id = id;
    Result<SceneCamera> camera = check_id(id) ? next.make_camera(std::move(named)) : check_id(id).error();
    if (!camera) return below("/cameras/" + token(id), camera.error());
    next.cameras_.emplace(id, std::move(*camera));
  }
  for (const auto& [id, entry] : document.bindings) {
    Binding named = entry;
    named.id = id;
    Result<SceneBinding> binding = check_id(id) ? next.make_binding(std::move(named)) : check_id(id).error();
    if (!binding) return below("/bindings/" + token(id), binding.error());
    next.bindings_.emplace(id, std::move(*binding));
  }
  take_over(std::move(next));
  return Ok{};
}

// Revisions of entities whose ids stay go on.
template <class Entity>
void Scene::replace(std::map<std::string, Entity>& entities, std::map<std::string, Entity> next,
                    std::map<std::string, ChangedEntity<Entity>> Change::*part) {
  for (const auto& [id, entity] : entities) keep(part, entities, id);
  for (auto& [id, entity] : next) {
    keep(part, entities, id);
    entity.revision = next_revision(part, entities, id);
  }
  entities = std::move(next);
}

void Scene::take_over(Scene next) {
  replace(bindings_, std::move(next.bindings_), &Change::bindings);
  replace(cameras_, std::move(next.cameras_), &Change::cameras);
  replace(goals_, std::move(next.goals_), &Change::goals);
  replace(objects_, std::move(next.objects_), &Change::objects);
  // Another figure under the same id has a pose of its own.
  for (const auto& [id, figure] : figures_) {
    if (next.figures_.contains(id)) keep_pose(id);
  }
  replace(figures_, std::move(next.figures_), &Change::figures);
  count();
}

void Scene::resume(Revision revision, const std::map<std::string, Revision>& revisions) {
  revision_ = revision;
  const auto put = [&revisions](auto& entities, const char* path) {
    for (auto& [id, entity] : entities) {
      if (const auto found = revisions.find(path + id); found != revisions.end()) entity.revision = found->second;
    }
  };
  put(figures_, "/figures/");
  put(objects_, "/objects/");
  put(goals_, "/goals/");
  put(bindings_, "/bindings/");
  put(cameras_, "/cameras/");
}

Result<const SceneFigure*> Scene::find_figure(const std::string& id) const {
  if (!id.empty()) {
    const auto found = figures_.find(id);
    if (found == figures_.end()) return unknown("figure", id, keys(figures_), "/figure");
    return &found->second;
  }
  if (figures_.size() == 1) return &figures_.begin()->second;
  if (const auto body = figures_.find("body"); body != figures_.end()) return &body->second;
  if (figures_.empty())
    return Error{"unknown_figure", "the scene has no figure", "/figure", "make one with figure.set or scene.new"};
  return Error{"ambiguous_figure", "the scene has several figures and none is called body", "/figure",
               did_you_mean("", keys(figures_))};
}

Status Scene::check_id(const std::string& id) const {
  if (valid_id(id)) return Ok{};
  return Error{"bad_id", "an id has 1 to 64 letters, digits, '_', '.' or '-' and starts with none of the last two",
               "/id", "as in right_hand-2"};
}

int Scene::clear_goals(const std::string& figure) {
  int removed = 0;
  for (auto it = goals_.begin(); it != goals_.end();) {
    const auto current = it++;
    if (!figure.empty() && current->second.goal.figure != figure) continue;
    const std::string id = current->first;
    drop_goal(id);
    ++removed;
  }
  if (removed > 0) count();
  return removed;
}

void Scene::drop_goal(const std::string& id) {
  drop_bindings([&](const BindingTarget& to) { return to.goal == id; });
  keep_goal(id);
  goals_.erase(id);
}

void Scene::settle(const std::string& figure, const std::vector<double>& q) {
  const auto found = figures_.find(figure);
  if (found != figures_.end()) std::copy(q.begin(), q.end(), found->second.q.begin());
}

}  // namespace posed
