// The edits that keys make of goals, as requests of the protocol. Pure.
#pragma once

#include <string>

#include "client/cli/view/station.h"

namespace posed::view {

struct Edit {
  std::string method, params;  // JSON
  std::string key;             // an edit that waits is replaced by a later one with the same key; empty: never
};

// The point that a nudge moves, in the frame that the goal is relative to; null: the goal's kind has none.
Vec3* handle_of(GoalPayload& payload);

// Moves the goal's handle by `delta`, in the world. Errors say why it can not be moved.
Status nudge(Goal& goal, const Vec3& delta, const Station& station);
// One notch of ten to the decade, up or down.
GoalWeight notched(const GoalWeight& weight, bool up);

// goal.set with the goal's handle, weight, or whether it is enabled.
Edit move_edit(const Goal& goal, const std::string& gesture);
Edit weight_edit(const Goal& goal, const std::string& gesture);
Edit enabled_edit(const Goal& goal);

}  // namespace posed::view
