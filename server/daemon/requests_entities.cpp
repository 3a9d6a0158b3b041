// Figures, goals, objects, bindings and cameras as they are.
#include "common/names.h"
#include "server/daemon/requests.h"

namespace posed {
namespace {

template <class Map>
auto* find(const Map& map, const std::string& id, const char* what, Responder& responder) {
  const auto found = map.find(id);
  if (found != map.end()) return &found->second;
  responder.error({std::string("unknown_") + what, std::string("no ") + what + " is called " + id.substr(0, 64),
                   "/params/id", did_you_mean(id, keys(map))});
  return static_cast<decltype(&found->second)>(nullptr);
}

proto::GoalResult message(const SceneGoal& goal, std::string held_by) {
  return {goal.goal, goal.revision, std::move(held_by)};
}
proto::ObjectResult message(const SceneObject& object) {
  return {object.object, object.revision};
}
proto::BindingResult message(const SceneBinding& binding) {
  return {binding.binding, binding.revision};
}

proto::CameraResult message(const SceneCamera& camera) {
  return {camera.camera, camera.revision};
}

}  // namespace

void Requests::on(const proto::FigureGet& m, Responder responder) {
  const SceneFigure* figure = find(p_.scene.figures(), m.id, "figure", responder);
  if (!figure) return;
  proto::FigureResult result;
  result.entry = figure->entry;
  result.document = figure->tree->document();
  result.entity_revision = figure->revision;
  for (int i = 0; i < figure->tree->size(); ++i) {
    const Joint& joint = figure->tree->joint(i);
    result.q_layout.push_back({joint.name, joint.type, figure->tree->q_at(i), q_size(joint.type)});
  }
  responder.result(result);
}

void Requests::on(const proto::FigureList&, Responder responder) {
  proto::FigureListResult result;
  for (const auto& [id, figure] : p_.scene.figures()) {
    result.figures.push_back(
        {id, figure.entry.template_name, figure.entry.stature, figure.tree->size(), figure.revision});
  }
  responder.result(result);
}

void Requests::on(const proto::GoalGet& m, Responder responder) {
  if (const SceneGoal* goal = find(p_.scene.goals(), m.id, "goal", responder))
    responder.result(message(*goal, p_.editing.holds().holder(m.id, p_.clock.now())));
}

void Requests::on(const proto::GoalList&, Responder responder) {
  proto::GoalListResult result;
  for (const auto& [id, goal] : p_.scene.goals())
    result.goals.push_back(message(goal, p_.editing.holds().holder(id, p_.clock.now())));
  responder.result(result);
}

void Requests::on(const proto::ObjectGet& m, Responder responder) {
  if (const SceneObject* object = find(p_.scene.objects(), m.id, "object", responder))
    responder.result(message(*object));
}

void Requests::on(const proto::ObjectList&, Responder responder) {
  proto::ObjectListResult result;
  for (const auto& [id, object] : p_.scene.objects()) result.objects.push_back(message(object));
  responder.result(result);
}

void Requests::on(const proto::BindingGet& m, Responder responder) {
  if (const SceneBinding* binding = find(p_.scene.bindings(), m.id, "binding", responder))
    responder.result(message(*binding));
}

void Requests::on(const proto::BindingList&, Responder responder) {
  proto::BindingListResult result;
  for (const auto& [id, binding] : p_.scene.bindings()) result.bindings.push_back(message(binding));
  responder.result(result);
}

void Requests::on(const proto::CameraGet& m, Responder responder) {
  if (const SceneCamera* camera = find(p_.scene.cameras(), m.id, "camera", responder))
    responder.result(message(*camera));
}

void Requests::on(const proto::CameraList&, Responder responder) {
  proto::CameraListResult result;
  for (const auto& [id, camera] : p_.scene.cameras()) result.cameras.push_back(message(camera));
  responder.result(result);
}

}  // namespace posed
