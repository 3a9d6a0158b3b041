#include "server/scene/change.h"

#include <algorithm>

namespace posed {
namespace {

template <class Entity>
void name(const std::map<std::string, ChangedEntity<Entity>>& part, const char* path, std::vector<std::string>& out) {
  for (const auto& [id, changed] : part) out.push_back(path + id);
}

std::size_t bytes_of(const FigureDocument& document) {
  return document.segments.size() * 1024 + (document.sites.size() + document.aliases.size()) * 256;
}
std::size_t bytes_of(const SceneFigure& figure) {
  return sizeof figure + figure.q.size() * sizeof(double) + figure.entry.pins.size() * 256 + figure.entry.user.size() +
         figure.entry.label.size() + (figure.entry.document ? bytes_of(*figure.entry.document) * 2 : 0);
}
std::size_t bytes_of(const SceneGoal& goal) {
  return sizeof goal + 512 + goal.goal.user.size() + goal.goal.label.size();
}
std::size_t bytes_of(const SceneObject& object) {
  return sizeof object + object.object.shapes.size() * sizeof(Shape) + object.object.user.size() +
         object.object.label.size();
}
std::size_t bytes_of(const SceneBinding& binding) {
  return sizeof binding + binding.binding.user.size() + binding.binding.label.size();
}
std::size_t bytes_of(const SceneCamera& camera) {
  return sizeof camera + camera.camera.user.size() + camera.camera.label.size();
}

template <class Entity>
std::size_t bytes_of(const std::map<std::string, ChangedEntity<Entity>>& part) {
  std::size_t bytes = 0;
  for (const auto& [id, changed] : part) bytes += 128 + (changed.other ? bytes_of(*changed.other) : 0);
  return bytes;
}

template <class Entity>
bool joins(const std::map<std::string, ChangedEntity<Entity>>& first,
           const std::map<std::string, ChangedEntity<Entity>>& next, Revision began) {
  return std::all_of(next.begin(), next.end(), [&](const auto& entry) {
    const auto before = first.find(entry.first);
    const Content found = entry.second.other ? entry.second.other->content : 0;
    // Of what was not there nobody knows since when: it may be another's edit that the step would have to come before.
    if (before == first.end()) return found != 0 && (found == kAtStart || found < began);
    return before->second.expected == found;
  });
}

template <class Entity>
void take_in(std::map<std::string, ChangedEntity<Entity>>& first,
             const std::map<std::string, ChangedEntity<Entity>>& next) {
  for (const auto& [id, changed] : next) {
    const auto [place, is_new] = first.try_emplace(id, changed);
    if (!is_new) place->second.expected = changed.expected;
  }
}

}  // namespace

bool Change::empty() const {
  return figures.empty() && objects.empty() && goals.empty() && bindings.empty() && cameras.empty() && poses.empty();
}

std::vector<std::string> Change::entities() const {
  std::vector<std::string> all;
  name(figures, "/figures/", all);
  name(objects, "/objects/", all);
  name(goals, "/goals/", all);
  name(bindings, "/bindings/", all);
  name(cameras, "/cameras/", all);
  for (const auto& [figure, pose] : poses) {
    if (pose.asked) all.push_back("/figures/" + figure + "/q");
  }
  return all;
}

std::size_t Change::bytes() const {
  std::size_t bytes = bytes_of(figures) + bytes_of(objects) + bytes_of(goals) + bytes_of(bindings) + bytes_of(cameras);
  for (const auto& [figure, pose] : poses) bytes += 128 + pose.q.size() * sizeof(double);
  return bytes;
}

bool Change::join(const Change& next, Revision began) {
  if (!joins(figures, next.figures, began) || !joins(objects, next.objects, began) ||
      !joins(goals, next.goals, began) || !joins(bindings, next.bindings, began) ||
      !joins(cameras, next.cameras, began))
    return false;
  const auto between = [this](const auto& entry) {
    const auto before = poses.find(entry.first);
    return before != poses.end() && before->second.expected != entry.second.other;
  };
  for (const auto& entry : next.poses) {
    if (between(entry) && (entry.second.asked || poses.at(entry.first).asked)) return false;
  }
  take_in(figures, next.figures);
  take_in(objects, next.objects);
  take_in(goals, next.goals);
  take_in(bindings, next.bindings);
  take_in(cameras, next.cameras);
  for (const auto& entry : next.poses) {
    // Another has moved the figure between: its pose will be solved anew, from where it then stands.
    if (between(entry)) {
      poses.at(entry.first).expected = 0;
      continue;
    }
    const auto [place, is_new] = poses.try_emplace(entry.first, entry.second);
    if (is_new) continue;
    place->second.expected = entry.second.expected;
    place->second.asked = place->second.asked || entry.second.asked;
  }
  return true;
}

}  // namespace posed
