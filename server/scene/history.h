// Who has done what: the steps that `edit.undo` takes back, one after the other, each by whoever made it. In memory,
// bounded: the oldest are forgotten.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
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
  Revision revision = 0;  // the scene's, after its last edit
  Nanoseconds t_ns = 0;   // of its last edit
  Editor by;
  std::string method, label, gesture;
  Change change;
  std::uint64_t applied = 0;  // orders those that stand: the scene is what they make of the beginning, one by one
  std::size_t bytes = 0;      // of memory that it is counted with
  bool undone = false;
  std::uint64_t undone_at = 0;  // orders the undone ones; 0: it can not be redone any more
};

class History {
 public:
  static constexpr std::size_t kMostSteps = 1000;
  static constexpr std::size_t kMostBytes = 64 << 20;

  struct Added {
    std::uint64_t number;
    std::optional<Step> was;  // the step that it went into, as it was before
  };
  // An edit of the same gesture goes into the editor's last step, where it could as well have been done then: what
  // others have done since has nothing to do with it.
  Added add(Step step);
  // The editor's last step that stands, or the one of this number; the last that was undone. Null: there is none.
  Step* to_undo(const std::string& identity, std::uint64_t number = 0);
  Step* to_redo(const std::string& identity);
  void undone(Step& step);
  void redone(Step& step);
  // As if what came of the step after `was`, or the whole of it, had never been.
  void put_back(std::uint64_t number, std::optional<Step> was);
  // The last step that came after this one and has built on it, or on what it would bring back. Null: there is none.
  const Step* built_upon(const Step& step) const;
  // Who else has last changed the entity of this path. Null: that is forgotten.
  const Step* last_change(const std::string& path, const Step& but_for) const;

  const std::deque<Step>& steps() const { return steps_; }  // oldest first

 private:
  void weigh(Step& step);
  void bound();

  std::deque<Step> steps_;
  std::uint64_t next_number_ = 1, next_undone_ = 1, next_applied_ = 1;
  std::size_t bytes_ = 0;
};

}  // namespace posed
