// Who has done what: the steps that `edit.undo` takes back, one after the other, each by whoever made it. In memory,
// bounded: the oldest are forgotten.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "common/time.h"
#include "server/scene/change.h"

namespace posed {

struct Editor {
  std::string identity;  // what survives a reconnect; secret
  std::string name;      // for others: the user, else the session
  std::string session;
};

struct Step {
  std::uint64_t number = 0;
  Revision began = 0;     // the scene's, after its first edit
  Revision revision = 0;  // after its last
  Nanoseconds t_ns = 0;   // of its last edit
  Editor by;
  std::string method, label, gesture;
  Change change;
  bool undone = false;
  std::uint64_t undone_at = 0;  // orders the undone ones; 0: it can not be redone any more
};

class History {
 public:
  static constexpr std::size_t kMostSteps = 1000;
  static constexpr std::size_t kMostBytes = 64 << 20;

  // The step's number. An edit of the same gesture goes into the editor's last step, if `joins`: nobody else has
  // changed since what that step is about.
  std::uint64_t add(Step step, bool joins);
  // The editor's last step that is not undone, or the last that was; or the one of this number. Null: there is none.
  Step* to_undo(const std::string& identity, std::uint64_t number = 0);
  Step* to_redo(const std::string& identity);
  void undone(Step& step);
  void redone(Step& step);
  void forget(std::uint64_t number);
  // Who, other than this one, has last changed the entity of this path; "somebody" where that is forgotten.
  std::string last_editor(const std::string& path, const std::string& but_for) const;

  const std::deque<Step>& steps() const { return steps_; }  // oldest first

 private:
  void bound();

  std::deque<Step> steps_;
  std::uint64_t next_number_ = 1, next_undone_ = 1;
  std::size_t bytes_ = 0;
};

}  // namespace posed
