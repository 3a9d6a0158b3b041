#include "client/cli/view/desk.h"

#include <algorithm>

#include "client/cli/view/scenery.h"
#include "client/cli/view/words.h"

namespace posed::view {
namespace {

constexpr double kGestureSeconds = 1.0;  // keys that follow sooner are one step to undo
constexpr double kNoteSeconds = 5.0;
constexpr double kOrbit = 0.12;  // rad
constexpr double kPan = 8.0;     // dots
constexpr double kZoom = 0.85;

}  // namespace

const Goal* Desk::wanted(const std::string& id, const Station& station) const {
  if (const auto ours = pending_.find(id); ours != pending_.end()) return &ours->second.goal;
  const proto::GoalResult* theirs = station.entities->goal(id);
  return theirs == nullptr ? nullptr : &theirs->goal;
}

void Desk::say(std::string text, bool bad, double now) {
  note_ = {std::move(text), bad};
  note_until_ = now + kNoteSeconds;
}

void Desk::frame(const Station& station, Size size) {
  cameras_.fit(bounds(station), layout(size, alone_, view_, list_).dots());
}

void Desk::follow(const Station& station, Size size, double now) {
  std::erase_if(pending_, [&](const auto& p) {
    return p.second.edit <= station.edits_done || station.entities->goal(p.first) == nullptr;
  });
  if (station.entities->goal(goal_) == nullptr) {
    goal_.clear();
    // One that has a place is the better start.
    for (const proto::GoalResult& g : station.entities->goals) {
      GoalPayload payload = g.goal.payload;
      if (goal_.empty() && handle_of(payload) != nullptr) goal_ = g.goal.id;
    }
    if (goal_.empty() && !station.entities->goals.empty()) goal_ = station.entities->goals.front().goal.id;
  }
  if (std::exchange(notes_, station.notes) < station.notes) say(station.note.text, station.note.bad, now);
  const bool whole = station.pose && !station.pose->figures.empty() && !station.entities->figures.empty();
  if (whole && !std::exchange(framed_, true)) frame(station, size);
}

void Desk::sent(std::uint64_t edit) {
  const auto found = pending_.find(pending_goal_);
  if (found != pending_.end()) found->second.edit = edit;
}

void Desk::choose(View view) {
  if (view == view_) alone_ = !alone_;
  view_ = view;
}

void Desk::next_goal(const Station& station, int by) {
  const auto& goals = station.entities->goals;
  const auto count = static_cast<int>(goals.size());
  for (int i = 0; i < count; ++i) {
    if (goals[static_cast<std::size_t>(i)].goal.id != goal_) continue;
    goal_ = goals[static_cast<std::size_t>((i + by + count) % count)].goal.id;
    return;
  }
}

std::string Desk::gesture(const std::string& what, double now) {
  if (what != gesture_of_ || now > gesture_until_) ++gestures_;
  gesture_of_ = what;
  gesture_until_ = now + kGestureSeconds;
  return name_ + '-' + std::to_string(gestures_);
}

Desk::Outcome Desk::edit_goal(Command command, bool shift, const Station& station, double now) {
  const Goal* goal = wanted(goal_, station);
  if (goal == nullptr) return say("there is no goal to change", true, now), Outcome{};
  Pending next{*goal};
  Outcome outcome;
  if (command == Command::heavier || command == Command::lighter) {
    next.goal.weight = notched(goal->weight, command == Command::heavier);
    outcome.edit = weight_edit(next.goal, gesture("weight " + goal_, now));
  } else if (command == Command::on_off) {
    next.goal.enabled = !goal->enabled;
    outcome.edit = enabled_edit(next.goal);
  } else {
    const Camera camera = cameras_.camera(view_, 1, 1);
    const double far = step_ * (shift ? 10.0 : 1.0);
    const Vec3 delta = far * (command == Command::nudge_up       ? camera.up
                              : command == Command::nudge_down   ? -camera.up
                              : command == Command::nudge_right  ? camera.right
                              : command == Command::nudge_left   ? -camera.right
                              : command == Command::nudge_nearer ? camera.back
                                                                 : -camera.back);
    if (const Status moved = nudge(next.goal, delta, station); !moved)
      return say(moved.error().message, true, now), Outcome{};
    outcome.edit = move_edit(next.goal, gesture("move " + goal_, now));
  }
  next.edit = UINT64_MAX;  // until it is sent
  pending_goal_ = goal_;
  pending_.insert_or_assign(goal_, std::move(next));
  return outcome;
}

void Desk::look(Command command, Size size) {
  using C = Command;
  const auto pane = layout(size, alone_, view_, list_).dots()[static_cast<std::size_t>(view_)];
  const auto step = [&](C right, C left, C up, C down) {
    return std::array{command == right  ? 1.0
                      : command == left ? -1.0
                                        : 0.0,
                      command == up     ? 1.0
                      : command == down ? -1.0
                                        : 0.0};
  };
  const auto orbit = step(C::orbit_right, C::orbit_left, C::orbit_up, C::orbit_down);
  auto pan = step(C::pan_right, C::pan_left, C::pan_up, C::pan_down);
  if (view_ == View::perspective)
    cameras_.orbit(kOrbit * orbit[0], kOrbit * orbit[1]);
  else
    pan = {pan[0] + orbit[0], pan[1] + orbit[1]};
  cameras_.pan(view_, pane[0], pane[1], kPan * pan[0], kPan * pan[1]);
}

Desk::Outcome Desk::act(Command command, bool shift, const Station& station, Size size, double now) {
  using C = Command;
  const auto by = [&](int step) {
    view_ = kViews[(static_cast<std::size_t>(view_) + 4 + static_cast<std::size_t>(step)) % 4];
  };
  switch (command) {
    case C::next_goal:
      next_goal(station, 1);
      break;
    case C::previous_goal:
      next_goal(station, -1);
      break;
    case C::step:
      step_ = step_ > 0.05 ? 0.001 : step_ * 10.0;
      say("a nudge is " + metres_text(step_), false, now);
      break;
    case C::undo:
      return {Then::nothing, Edit{"edit.undo", "{}", ""}};
    case C::redo:
      return {Then::nothing, Edit{"edit.redo", "{}", ""}};
    case C::nearer:
      cameras_.zoom(kZoom);
      break;
    case C::farther:
      cameras_.zoom(1.0 / kZoom);
      break;
    case C::fit:
      frame(station, size);
      break;
    case C::top:
      choose(View::top);
      break;
    case C::perspective:
      choose(View::perspective);
      break;
    case C::front:
      choose(View::front);
      break;
    case C::side:
      choose(View::side);
      break;
    case C::next_view:
      by(1);
      break;
    case C::previous_view:
      by(-1);
      break;
    case C::maximise:
      alone_ = !alone_;
      break;
    case C::list:
      list_ = !list_;
      break;
    case C::help:
      help_ = !help_;
      break;
    case C::leave:
      if (!std::exchange(help_, false)) alone_ = false;
      break;
    case C::redraw:
      return {Then::redraw, {}};
    case C::suspend:
      return {Then::suspend, {}};
    case C::quit:
      return {Then::quit, {}};
    case C::orbit_up:
    case C::orbit_down:
    case C::orbit_right:
    case C::orbit_left:
    case C::pan_up:
    case C::pan_down:
    case C::pan_right:
    case C::pan_left:
      look(command, size);
      break;
    default:
      return edit_goal(command, shift, station, now);
  }
  return {};
}

}  // namespace posed::view
