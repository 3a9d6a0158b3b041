// Figures, goals, objects and bindings.
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

proto::GoalResult message(const SceneGoal& goal) {
  return {goal.goal, goal.revision};
}
proto::ObjectResult message(const SceneObject& object) {
  return {object.object, object.revision};
}
proto::BindingResult message(const SceneBinding& binding) {
  return {binding.binding, binding.revision};
}

}  // namespace

void Requests::answer(const Result<Edited>& edited, Responder& responder) {
  if (!edited) return responder.params_error(edited.error());
  responder.result(proto::EditResult{edited->id, edited->revision, edited->entity_revision});
  p_.edited(connection_);
}

void Requests::on(const proto::FigureSet& m, Responder responder) {
  FigureEntry entry;
  if (const auto found = p_.scene.figures().find(m.id); found != p_.scene.figures().end()) entry = found->second.entry;
  entry.id = m.id;
  if (m.document) {
    entry.template_name.clear();
    entry.document = m.document;
  }
  if (m.template_name.value()) entry.document.reset();
  m.template_name.apply(entry.template_name);
  if (m.document && m.template_name.value()) entry.document = m.document;  // the scene says what is wrong with both
  m.stature.apply(entry.stature, FigureEntry{}.stature);
  m.label.apply(entry.label);
  m.user.apply(entry.user);
  answer(p_.scene.set_figure(std::move(entry), if_revision_), responder);
}

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

void Requests::on(const proto::FigureRemove& m, Responder responder) {
  answer(p_.scene.remove_figure(m.id, if_revision_), responder);
}

void Requests::on(const proto::FigurePin& m, Responder responder) {
  answer(p_.scene.pin(m.figure, m.segment, m.hold, if_revision_), responder);
}

void Requests::on(const proto::GoalSet& m, Responder responder) {
  answer(p_.scene.set_goal(m.edit, if_revision_), responder);
}

void Requests::on(const proto::GoalGet& m, Responder responder) {
  if (const SceneGoal* goal = find(p_.scene.goals(), m.id, "goal", responder)) responder.result(message(*goal));
}

void Requests::on(const proto::GoalList&, Responder responder) {
  proto::GoalListResult result;
  for (const auto& [id, goal] : p_.scene.goals()) result.goals.push_back(message(goal));
  responder.result(result);
}

void Requests::on(const proto::GoalRemove& m, Responder responder) {
  answer(p_.scene.remove_goal(m.id, if_revision_), responder);
}

void Requests::on(const proto::GoalClear& m, Responder responder) {
  if (!m.figure.empty()) {
    if (const auto figure = p_.scene.find_figure(m.figure); !figure) return responder.params_error(figure.error());
  }
  const int removed = p_.scene.clear_goals(m.figure);
  responder.result(proto::ClearResult{removed, p_.scene.revision()});
  if (removed > 0) p_.edited(connection_);
}

void Requests::on(const proto::ObjectSet& m, Responder responder) {
  answer(p_.scene.set_object(m.edit, if_revision_), responder);
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

void Requests::on(const proto::ObjectRemove& m, Responder responder) {
  answer(p_.scene.remove_object(m.id, if_revision_), responder);
}

void Requests::on(const proto::BindingSet& m, Responder responder) {
  answer(p_.scene.set_binding(m.edit, if_revision_), responder);
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

void Requests::on(const proto::BindingRemove& m, Responder responder) {
  answer(p_.scene.remove_binding(m.id, if_revision_), responder);
}

}  // namespace posed
