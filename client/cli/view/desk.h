// The viewer's own state, and what a key does to it. Pure: time comes in, edits go out.
#pragma once

#include <map>
#include <string>

#include "client/cli/view/camera.h"
#include "client/cli/view/edits.h"
#include "client/cli/view/keys.h"
#include "client/cli/view/layout.h"

namespace posed::view {

// A goal that we have edited and the daemon has not answered for yet: shown as we want it.
struct Pending {
  Goal goal;
  std::uint64_t edit = 0;  // the last edit of it
};

class Desk {
 public:
  // `name`: of gestures, another for each viewer.
  explicit Desk(std::string name) : name_(std::move(name)) {}

  enum class Then { nothing, redraw, suspend, quit };
  struct Outcome {
    Then then = Then::nothing;
    std::optional<Edit> edit;
  };
  // `now` in seconds, of any clock that only grows.
  Outcome act(Command command, bool shift, const Station& station, Size size, double now);
  // The edit that act() gave out is on its way, as number `edit`.
  void sent(std::uint64_t edit);
  // Takes in what has come: a goal is chosen if none is, answered edits are no longer pending, the views are framed
  // when the first pose is there.
  void follow(const Station& station, Size size, double now);

  const Cameras& cameras() const { return cameras_; }
  View view() const { return view_; }
  bool alone() const { return alone_; }  // the view, with no other
  bool list() const { return list_; }
  bool help() const { return help_; }
  const std::string& goal() const { return goal_; }
  double step() const { return step_; }  // m
  const std::map<std::string, Pending>& pending() const { return pending_; }
  // What was said last, for a few seconds.
  const Note* note(double now) const { return now < note_until_ ? &note_ : nullptr; }
  // The goal as we want it: pending, or the daemon's. Null: there is none.
  const Goal* wanted(const std::string& id, const Station& station) const;

 private:
  void say(std::string text, bool bad, double now);
  void choose(View view);
  void next_goal(const Station& station, int by);
  void frame(const Station& station, Size size);
  std::string gesture(const std::string& what, double now);
  Outcome edit_goal(Command command, bool shift, const Station& station, double now);
  void look(Command command, Size size);

  std::string name_;
  Cameras cameras_;
  View view_ = View::perspective;
  bool alone_ = false, list_ = true, help_ = false, framed_ = false;
  std::string goal_;
  double step_ = 0.01;
  std::map<std::string, Pending> pending_;
  std::string pending_goal_;  // of the edit that was given out last
  std::string gesture_of_;
  double gesture_until_ = 0.0;
  int gestures_ = 0;
  Note note_;
  double note_until_ = 0.0;
  std::uint64_t notes_ = 0;
};

}  // namespace posed::view
