// The one door through which edits come to the scene: all or nothing, with who may and who did. One thread.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/scene/history.h"
#include "server/scene/holds.h"
#include "server/scene/scene.h"

namespace posed {

// How an edit is made, and by whom.
struct EditBy {
  Editor editor;
  Holds::Owner owner = 0;  // the connection
  Nanoseconds t_ns = 0;
  std::string method, label, gesture;
  bool force = false;  // goals that others hold are no hindrance
};

// An edit that has been done.
struct Done {
  Change change;           // takes it back
  std::uint64_t step = 0;  // of the history
  std::vector<std::string> entities;
  std::optional<Step> was = {};  // the step as it was before
};

class Editing {
 public:
  explicit Editing(Scene& scene) : scene_(scene) {}

  // Runs `edit(scene)`, which gives a Result; on an error the scene is as it was. Errors: those of `edit`, "held".
  template <class Edit>
  auto edit(const EditBy& by, Edit edit) -> decltype(edit(std::declval<Scene&>())) {
    scene_.begin();
    auto result = edit(scene_);
    if (!result) {
      scene_.rollback();
      return result;
    }
    if (const Status finished = finish(by); !finished) return finished.error();
    return result;
  }

  // The editor's own last edit, or the one of this step. Errors: "nothing_to_undo", "undo_conflict", "held".
  Result<Done> undo(const EditBy& by, std::uint64_t step = 0);
  // Errors: "nothing_to_redo", "undo_conflict", "held".
  Result<Done> redo(const EditBy& by);

  // What the last edit has done; nothing where it changed nothing.
  std::optional<Done> take_done() { return std::exchange(done_, std::nullopt); }
  // As if these edits, the last ones, oldest first, had never been.
  void discard(std::vector<Done> edits);

  // Errors: "unknown_goal", "held".
  Status grab(const EditBy& by, const std::string& goal);
  Status release(const EditBy& by, const std::string& goal);
  void gone(Holds::Owner owner) { holds_.release_all(owner); }

  const History& history() const { return history_; }
  const Holds& holds() const { return holds_; }

 private:
  Status finish(const EditBy& by);
  Status check_holds(const EditBy& by, const Change& change) const;
  void renew_holds(const EditBy& by, const Change& change);
  Result<Done> go_back(const EditBy& by, Step& step);
  Error conflict_error(const std::string& path, bool gone, const Step* since) const;

  Scene& scene_;
  History history_;
  Holds holds_;
  std::optional<Done> done_;
};

}  // namespace posed
