// What an edit has changed, as a value that knows its inverse: for each entity what stands in its place when the edit
// is taken back. Taken back, it is the value that does it again. Plain values; Scene makes and applies them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/scene/entities.h"

namespace posed {

template <class Entity>
struct ChangedEntity {
  std::optional<Entity> other;  // what is to stand there; none: nothing
  Content expected = 0;         // what must stand there for that; 0: nothing
};

// The joint values that a figure had: they come back where nobody else's edit has had to do with the figure since.
struct ChangedPose {
  std::vector<double> q;
  Content other = 0, expected = 0;
  bool asked = false;     // the edit was of the pose itself
  Revision revision = 0;  // of the figure, before
};

struct Change {
  // All by id; poses by their figures'.
  std::map<std::string, ChangedEntity<SceneFigure>> figures;
  std::map<std::string, ChangedEntity<SceneObject>> objects;
  std::map<std::string, ChangedEntity<SceneGoal>> goals;
  std::map<std::string, ChangedEntity<SceneBinding>> bindings;
  std::map<std::string, ChangedEntity<SceneCamera>> cameras;
  std::map<std::string, ChangedPose> poses;

  bool empty() const;
  // As paths of the document: "/goals/g1".
  std::vector<std::string> entities() const;
  // Of memory, more or less.
  std::size_t bytes() const;
  // Takes `next` in, which came after: the two are one change then. False, and nothing changes, where somebody else's
  // change of the same lies between; of what is new in `next`, one after the revision `began`.
  bool join(const Change& next, Revision began);
};

// Why a change can not be taken back.
struct Conflict {
  std::string what;    // "goal g1"
  std::string path;    // "/goals/g1"
  std::string by;      // who changed it since; empty: it is gone
  std::string reason;  // "changed", "removed"
};

}  // namespace posed
