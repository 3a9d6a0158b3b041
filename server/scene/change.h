// What an edit has changed, as a value that knows its inverse: for each entity what stands in its place when the edit
// is taken back. Taken back, it is the value that does it again. Plain values; Scene makes and applies them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/scene/entities.h"
#include "server/scene/footprint.h"

namespace posed {

template <class Entity>
struct ChangedEntity {
  std::optional<Entity> other;  // what is to stand there; none: nothing
  Content expected = 0;         // what must stand there for that; 0: nothing
};

// The joint values that a figure had: they come back where nobody else's edit has had to do with the figure since, or
// where the edit was of the pose itself.
struct ChangedPose {
  std::vector<double> q;
  Content other = 0, expected = 0;      // of the figure's `pose`; expected 0: it does not come back
  bool asked = false;                   // the edit was of the pose itself
  Revision revision = 0;                // of the figure, before
  Content other_q = 0, expected_q = 0;  // of its `posed`, where it was asked
};

struct Change {
  // All by id; poses by their figures'.
  std::map<std::string, ChangedEntity<SceneFigure>> figures;
  std::map<std::string, ChangedEntity<SceneObject>> objects;
  std::map<std::string, ChangedEntity<SceneGoal>> goals;
  std::map<std::string, ChangedEntity<SceneBinding>> bindings;
  std::map<std::string, ChangedEntity<SceneCamera>> cameras;
  std::map<std::string, ChangedPose> poses;
  Footprint print;

  bool empty() const;
  // As paths of the document: "/goals/g1".
  std::vector<std::string> entities() const;
  // Of memory, more or less.
  std::size_t bytes() const;
  // Whether the other could as well have been done before this one, or after it: they have nothing to do with each
  // other.
  bool commutes(const Change& other) const;
  // Takes `next` in, which came after: the two are one change then. False, and nothing changes, where `next` does not
  // begin where this ends.
  bool join(const Change& next);
};

// Why a change can not be taken back.
struct Conflict {
  std::string path;  // "/goals/g1"
  bool gone = false;
};

}  // namespace posed
