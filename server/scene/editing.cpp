#include "server/scene/editing.h"

#include <set>

#include "server/scene/errors.h"

namespace posed {
namespace {

// Goals that the change is about: their documents, or what sensor moves them.
std::set<std::string> goals_of(const Change& change, const Scene& scene) {
  std::set<std::string> goals;
  for (const auto& [id, goal] : change.goals) {
    // A goal that is only fitted anew to its figure is none's concern.
    const auto now = scene.goals().find(id);
    if (goal.other && now != scene.goals().end() && goal.other->revision == now->second.revision) continue;
    goals.insert(id);
  }
  for (const auto& [id, binding] : change.bindings) {
    if (binding.other) goals.insert(binding.other->binding.to.goal);
    if (const auto now = scene.bindings().find(id); now != scene.bindings().end())
      goals.insert(now->second.binding.to.goal);
  }
  goals.erase("");
  return goals;
}

// "/goals/g1" -> "goal g1".
std::string spoken(const std::string& path) {
  const std::size_t slash = path.find('/', 1);
  if (path.ends_with("/q")) return "the pose of figure " + path.substr(slash + 1, path.size() - slash - 3);
  return path.substr(1, slash - 2) + " " + path.substr(slash + 1);
}

}  // namespace

Status Editing::check_holds(const EditBy& by, const Change& change) const {
  if (by.force) return Ok{};
  for (const std::string& goal : goals_of(change, scene_)) {
    if (Status free = holds_.check(goal, by.owner, by.t_ns); !free) return free;
  }
  return Ok{};
}

void Editing::renew_holds(const EditBy& by, const Change& change) {
  for (const auto& [id, goal] : change.goals) {
    if (scene_.goals().contains(id))
      holds_.renew(id, by.owner, by.t_ns);
    else
      holds_.release(id);
  }
}

Status Editing::finish(const EditBy& by) {
  if (Status free = check_holds(by, scene_.kept()); !free) {
    scene_.rollback();
    return free;
  }
  Step step;
  step.change = scene_.commit();
  done_.reset();
  if (step.change.empty()) return Ok{};
  renew_holds(by, step.change);
  step.revision = scene_.revision();
  step.t_ns = by.t_ns;
  step.by = by.editor;
  step.method = by.method;
  step.label = by.label;
  step.gesture = by.gesture;
  done_ = Done{step.change, 0, step.change.entities(), {}};
  History::Added added = history_.add(std::move(step));
  done_->step = added.number;
  done_->was = std::move(added.was);
  return Ok{};
}

Error Editing::conflict_error(const std::string& path, bool gone, const Step* since) const {
  const std::string who =
      since ? since->by.name + " since, in step " + std::to_string(since->number) : "somebody since";
  return {"undo_conflict", spoken(path) + " was " + (gone ? "removed" : "changed") + " by " + who, "",
          "edit.history tells what was done; name another step of yours, or set it anew"};
}

Result<Done> Editing::go_back(const EditBy& by, Step& step) {
  if (const Status free = check_holds(by, step.change); !free) return free.error();
  if (const Step* on_it = step.undone ? nullptr : history_.built_upon(step)) {
    const std::string path = on_it->change.entities().front();
    return conflict_error(path, !scene_.has(path), on_it);
  }
  const auto entities = step.change.entities();
  Step was = step;
  if (const auto conflict = scene_.revert(step.change))
    return conflict_error(conflict->path, conflict->gone, history_.last_change(conflict->path, step));
  renew_holds(by, step.change);
  done_ = Done{step.change, step.number, entities, std::move(was)};
  return *done_;
}

Result<Done> Editing::undo(const EditBy& by, std::uint64_t number) {
  Step* step = history_.to_undo(by.editor.identity, number);
  if (!step) {
    return Error{"nothing_to_undo",
                 number == 0 ? "you have no edit to undo"
                             : "no edit of yours is step " + std::to_string(number) + ", or it is undone",
                 number == 0 ? "" : "/step", "edit.history lists the edits; those of others are theirs to undo"};
  }
  Result<Done> done = go_back(by, *step);
  if (done) history_.undone(*step);
  return done;
}

Result<Done> Editing::redo(const EditBy& by) {
  Step* step = history_.to_redo(by.editor.identity);
  if (!step)
    return Error{"nothing_to_redo", "you have undone nothing since your last edit", "", "edit.history lists the edits"};
  Result<Done> done = go_back(by, *step);
  if (done) history_.redone(*step);
  return done;
}

void Editing::discard(std::vector<Done> edits) {
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit) {
    (void)scene_.revert(edit->change);
    history_.put_back(edit->step, std::move(edit->was));
  }
}

Status Editing::grab(const EditBy& by, const std::string& goal) {
  if (!scene_.goals().contains(goal)) return unknown("goal", goal, keys(scene_.goals()), "/id");
  if (!by.force) {
    if (Status free = holds_.check(goal, by.owner, by.t_ns); !free) return free;
  }
  holds_.take(goal, by.owner, by.editor.name, by.t_ns);
  return Ok{};
}

Status Editing::release(const EditBy& by, const std::string& goal) {
  if (!scene_.goals().contains(goal)) return unknown("goal", goal, keys(scene_.goals()), "/id");
  if (!by.force) {
    if (Status free = holds_.check(goal, by.owner, by.t_ns); !free) return free;
  }
  holds_.release(goal);
  return Ok{};
}

}  // namespace posed
