// What a change builds and what it leans on. Two changes whose footprints do not clash may be done, and taken back, in
// either order. Plain values.
#pragma once

#include <set>
#include <string>

#include "server/scene/entities.h"

namespace posed {

struct Footprint {
  std::set<std::string> built;  // what came, went or took another form, as paths: "/goals/g1"
  std::set<std::string> leans;  // what that refers to, before or after

  bool clashes(const Footprint& other) const;
  void add(const Footprint& other);
  std::size_t bytes() const;
};

// Null: it was not there, or is not any more. A change of numbers alone, as a drag makes them, leaves nothing.
void mark(Footprint& print, const SceneFigure* before, const SceneFigure* after);
void mark(Footprint& print, const SceneObject* before, const SceneObject* after);
void mark(Footprint& print, const SceneGoal* before, const SceneGoal* after);
void mark(Footprint& print, const SceneBinding* before, const SceneBinding* after);
void mark(Footprint& print, const SceneCamera* before, const SceneCamera* after);

}  // namespace posed
