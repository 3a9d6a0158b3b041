#include "server/scene/change.h"

#include <algorithm>

#include "server/solver/kinematics.h"

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
bool touch(const std::map<std::string, ChangedEntity<Entity>>& a,
           const std::map<std::string, ChangedEntity<Entity>>& b) {
  return std::any_of(a.begin(), a.end(), [&b](const auto& entry) { return b.contains(entry.first); });
}

template <class Entity>
bool follows(const std::map<std::string, ChangedEntity<Entity>>& first,
             const std::map<std::string, ChangedEntity<Entity>>& next) {
  return std::all_of(next.begin(), next.end(), [&](const auto& entry) {
    const auto before = first.find(entry.first);
    return before == first.end() || before->second.expected == (entry.second.other ? entry.second.other->content : 0);
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

// A figure that goes takes its pose along. `first`: as it was before the whole change; `last`: before it went.
void give_pose(SceneFigure& first, const SceneFigure& last, const ChangedPose& pose) {
  const bool alone = pose.expected == last.pose;
  if (alone || pose.asked)
    first.q = pose.q;
  else if (check_q(*first.tree, last.q))
    first.q = last.q;
  first.pose = alone ? pose.other : last.pose;
  first.posed = pose.asked ? pose.other_q : last.posed;
}

// Of a figure that went and has come anew: the pose is as much another as if somebody had said it.
ChangedPose pose_before(const SceneFigure& kept, const ChangedPose& after) {
  return {
      kept.q, kept.pose, after.expected, true, kept.revision, kept.posed, after.asked ? after.expected_q : kAtStart};
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
    if (pose.asked && !figures.contains(figure)) all.push_back("/figures/" + figure + "/q");
  }
  return all;
}

std::size_t Change::bytes() const {
  std::size_t bytes =
      bytes_of(figures) + bytes_of(objects) + bytes_of(goals) + bytes_of(bindings) + bytes_of(cameras) + print.bytes();
  for (const auto& [figure, pose] : poses) bytes += 128 + pose.q.size() * sizeof(double);
  return bytes;
}

bool Change::commutes(const Change& o) const {
  const bool both_posed = std::any_of(poses.begin(), poses.end(), [&o](const auto& entry) {
    const auto other = o.poses.find(entry.first);
    return other != o.poses.end() && entry.second.asked && other->second.asked;
  });
  return !both_posed && !touch(figures, o.figures) && !touch(objects, o.objects) && !touch(goals, o.goals) &&
         !touch(bindings, o.bindings) && !touch(cameras, o.cameras) && !print.clashes(o.print);
}

bool Change::join(const Change& next) {
  if (!follows(figures, next.figures) || !follows(objects, next.objects) || !follows(goals, next.goals) ||
      !follows(bindings, next.bindings) || !follows(cameras, next.cameras))
    return false;
  for (const auto& [id, changed] : next.figures) {
    const auto pose = poses.find(id);
    if (changed.expected != 0 || pose == poses.end()) continue;
    std::optional<SceneFigure>& first = figures.try_emplace(id, changed).first->second.other;
    if (first) give_pose(*first, *changed.other, pose->second);
    poses.erase(pose);
  }
  for (const auto& [figure, after] : next.poses) {
    const auto [place, is_new] = poses.try_emplace(figure, after);
    ChangedPose& pose = place->second;
    if (is_new) {
      if (const auto gone = figures.find(figure); gone != figures.end() && gone->second.other)
        pose = pose_before(*gone->second.other, after);
      continue;
    }
    // Another has had to do with the figure between: its pose will be solved anew, from where it then stands.
    const bool alone = pose.expected == after.other;
    pose.expected = alone ? after.expected : 0;
    if (!after.asked) continue;
    if (!pose.asked) pose.other_q = after.other_q;
    if (!pose.asked && !alone) pose.q = after.q;
    pose.expected_q = after.expected_q;
    pose.asked = true;
  }
  take_in(figures, next.figures);
  take_in(objects, next.objects);
  take_in(goals, next.goals);
  take_in(bindings, next.bindings);
  take_in(cameras, next.cameras);
  print.add(next.print);
  return true;
}

}  // namespace posed
