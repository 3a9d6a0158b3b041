#include "server/scene/history.h"

#include <algorithm>

namespace posed {

std::uint64_t History::add(Step step, bool joins) {
  // What has been undone can not be redone on top of something new.
  for (Step& old : steps_) {
    if (old.undone && old.by.identity == step.by.identity) old.undone_at = 0;
  }
  Step* last = to_undo(step.by.identity);
  if (joins && last && !step.gesture.empty() && last->gesture == step.gesture) {
    const std::size_t before = last->change.bytes();
    if (last->change.join(step.change, last->began)) {
      bytes_ += last->change.bytes() - before;
      last->revision = step.revision;
      last->t_ns = step.t_ns;
      const std::uint64_t number = last->number;
      bound();
      return number;
    }
  }
  step.number = next_number_++;
  bytes_ += step.change.bytes();
  steps_.push_back(std::move(step));
  const std::uint64_t number = steps_.back().number;
  bound();
  return number;
}

void History::bound() {
  while (steps_.size() > kMostSteps || (bytes_ > kMostBytes && steps_.size() > 1)) {
    bytes_ -= steps_.front().change.bytes();
    steps_.pop_front();
  }
}

Step* History::to_undo(const std::string& identity, std::uint64_t number) {
  const auto found = std::find_if(steps_.rbegin(), steps_.rend(), [&](const Step& step) {
    return !step.undone && step.by.identity == identity && (number == 0 || step.number == number);
  });
  return found == steps_.rend() ? nullptr : &*found;
}

Step* History::to_redo(const std::string& identity) {
  Step* last = nullptr;
  for (Step& step : steps_) {
    if (step.undone && step.undone_at > 0 && step.by.identity == identity &&
        (!last || step.undone_at > last->undone_at))
      last = &step;
  }
  return last;
}

void History::undone(Step& step) {
  step.undone = true;
  step.undone_at = next_undone_++;
}

void History::redone(Step& step) {
  step.undone = false;
  step.undone_at = 0;
}

void History::forget(std::uint64_t number) {
  const auto found = std::find_if(steps_.begin(), steps_.end(), [&](const Step& s) { return s.number == number; });
  if (found == steps_.end()) return;
  bytes_ -= found->change.bytes();
  steps_.erase(found);
}

std::string History::last_editor(const std::string& path, const std::string& but_for) const {
  const Step* last = nullptr;
  for (const Step& step : steps_) {
    if (step.by.identity == but_for || (last && last->revision > step.revision)) continue;
    const std::vector<std::string> entities = step.change.entities();
    if (std::find(entities.begin(), entities.end(), path) != entities.end()) last = &step;
  }
  return last ? last->by.name : "somebody";
}

}  // namespace posed
