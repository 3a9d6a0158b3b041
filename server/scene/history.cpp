#include "server/scene/history.h"

#include <algorithm>

namespace posed {

History::Added History::add(Step step) {
  // What has been undone can not be redone on top of something new.
  for (Step& old : steps_) {
    if (old.undone && old.by.identity == step.by.identity) old.undone_at = 0;
  }
  Step* last = step.gesture.empty() ? nullptr : to_undo(step.by.identity);
  const bool joins =
      last && last->gesture == step.gesture && std::all_of(steps_.begin(), steps_.end(), [&](const Step& other) {
        return other.undone || other.applied <= last->applied || other.change.commutes(step.change);
      });
  if (joins) {
    Step was = *last;
    if (last->change.join(step.change)) {
      weigh(*last);
      last->revision = step.revision;
      last->t_ns = step.t_ns;
      bound();
      const std::uint64_t number = was.number;
      return {number, std::move(was)};
    }
  }
  step.number = next_number_++;
  step.applied = next_applied_++;
  steps_.push_back(std::move(step));
  weigh(steps_.back());
  bound();
  return {steps_.back().number, std::nullopt};
}

// What a step keeps changes when it is undone: what stood there and what came change places.
void History::weigh(Step& step) {
  bytes_ -= step.bytes;
  step.bytes = step.change.bytes();
  bytes_ += step.bytes;
}

void History::bound() {
  while (steps_.size() > kMostSteps || (bytes_ > kMostBytes && steps_.size() > 1)) {
    bytes_ -= steps_.front().bytes;
    steps_.pop_front();
  }
}

Step* History::to_undo(const std::string& identity, std::uint64_t number) {
  Step* last = nullptr;
  for (Step& step : steps_) {
    if (step.undone || step.by.identity != identity || (number != 0 && step.number != number)) continue;
    if (!last || step.applied > last->applied) last = &step;
  }
  return last;
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
  weigh(step);
}

void History::redone(Step& step) {
  step.undone = false;
  step.undone_at = 0;
  step.applied = next_applied_++;
  weigh(step);
}

void History::put_back(std::uint64_t number, std::optional<Step> was) {
  const auto found = std::find_if(steps_.begin(), steps_.end(), [&](const Step& s) { return s.number == number; });
  if (found == steps_.end()) return;
  bytes_ -= found->bytes;
  if (!was) return void(steps_.erase(found));
  *found = std::move(*was);
  bytes_ += found->bytes;
}

const Step* History::built_upon(const Step& step) const {
  const Step* last = nullptr;
  for (const Step& other : steps_) {
    if (other.undone || other.applied <= step.applied || (last && last->applied > other.applied)) continue;
    if (other.change.print.clashes(step.change.print)) last = &other;
  }
  return last;
}

const Step* History::last_change(const std::string& path, const Step& but_for) const {
  const Step* last = nullptr;
  for (const Step& step : steps_) {
    if (&step == &but_for || step.undone || (last && last->applied > step.applied)) continue;
    const std::vector<std::string> entities = step.change.entities();
    if (std::find(entities.begin(), entities.end(), path) != entities.end()) last = &step;
  }
  return last;
}

}  // namespace posed
