#include "server/scene/footprint.h"

#include <algorithm>

namespace posed {
namespace {

bool meet(const std::set<std::string>& a, const std::set<std::string>& b) {
  if (a.size() > b.size()) return meet(b, a);
  return std::any_of(a.begin(), a.end(), [&b](const std::string& path) { return b.contains(path); });
}

bool same_form(const SceneFigure& a, const SceneFigure& b) {
  if (a.tree == b.tree) return true;
  return !a.entry.template_name.empty() && a.entry.template_name == b.entry.template_name;
}
// Payloads that name nothing differ in numbers alone.
bool same_form(const SceneGoal& a, const SceneGoal& b) {
  const GoalKind kind = kind_of(a.goal.payload);
  return kind == kind_of(b.goal.payload) && takes_hold(kind) && has_frame(kind) && a.goal.figure == b.goal.figure &&
         a.goal.at == b.goal.at && a.goal.relative_to == b.goal.relative_to;
}
bool same_form(const SceneObject&, const SceneObject&) {
  return true;
}
bool same_form(const SceneBinding& a, const SceneBinding& b) {
  return a.binding.to == b.binding.to && a.binding.axes == b.binding.axes;
}
bool same_form(const SceneCamera& a, const SceneCamera& b) {
  return a.camera.relative_to == b.camera.relative_to;
}

void name(Footprint& print, const SceneFigure& figure) {
  print.built.insert("/figures/" + figure.entry.id);
}
void name(Footprint& print, const SceneObject& object) {
  print.built.insert("/objects/" + object.object.id);
}
void lean(Footprint& print, const GoalBase& base) {
  if (base.kind == GoalBase::Kind::segment) print.leans.insert("/figures/" + base.figure);
  if (base.kind == GoalBase::Kind::object) print.leans.insert("/objects/" + base.object);
}
void name(Footprint& print, const SceneGoal& goal) {
  print.built.insert("/goals/" + goal.goal.id);
  print.leans.insert("/figures/" + goal.goal.figure);
  lean(print, goal.goal.relative_to);
}
void name(Footprint& print, const SceneCamera& camera) {
  print.built.insert("/cameras/" + camera.camera.id);
  lean(print, camera.camera.relative_to);
}
void name(Footprint& print, const SceneBinding& binding) {
  const BindingTarget& to = binding.binding.to;
  const std::string target = !to.goal.empty()     ? "/goals/" + to.goal
                             : !to.object.empty() ? "/objects/" + to.object
                             : !to.camera.empty() ? "/cameras/" + to.camera
                                                  : "/figures/" + to.figure;
  print.built.insert("/bindings/" + binding.binding.id);
  // there is one at most
  print.built.insert(target + (to.joint.empty() ? "/binding" : "/joints/" + to.joint + "/binding"));
  print.leans.insert(target);
}

template <class Entity>
void mark_one(Footprint& print, const Entity* before, const Entity* after) {
  if (before && after && same_form(*before, *after)) return;
  if (before) name(print, *before);
  if (after) name(print, *after);
}

}  // namespace

bool Footprint::clashes(const Footprint& other) const {
  return meet(built, other.built) || meet(built, other.leans) || meet(leans, other.built);
}

void Footprint::add(const Footprint& other) {
  built.insert(other.built.begin(), other.built.end());
  leans.insert(other.leans.begin(), other.leans.end());
}

std::size_t Footprint::bytes() const {
  return (built.size() + leans.size()) * 128;
}

void mark(Footprint& print, const SceneFigure* before, const SceneFigure* after) {
  mark_one(print, before, after);
}
void mark(Footprint& print, const SceneObject* before, const SceneObject* after) {
  mark_one(print, before, after);
}
void mark(Footprint& print, const SceneGoal* before, const SceneGoal* after) {
  mark_one(print, before, after);
}
void mark(Footprint& print, const SceneBinding* before, const SceneBinding* after) {
  mark_one(print, before, after);
}
void mark(Footprint& print, const SceneCamera* before, const SceneCamera* after) {
  mark_one(print, before, after);
}

}  // namespace posed
