// What a goal asks for, checked, with its names resolved to places of a figure. Error paths begin at the goal
// ("/aim/axis", "/balance/support/1").
#pragma once

#include "common/goal.h"
#include "common/result.h"
#include "server/solver/body_tree.h"
#include "server/solver/spring_goal.h"

namespace posed {

inline constexpr double kMaxCoordinate = 1e6;   // m, of a place in the world
inline constexpr std::size_t kMaxSupport = 32;  // places of a balance goal
inline constexpr double kUnitQuatTolerance = 1e-3;

// A place where a goal takes hold. Errors: "unknown_segment", "unknown_site", "out_of_range".
Result<AttachedPoint> resolve_place(const Attachment& at, const BodyTree& tree, const std::string& path);

// Directions and quaternions come out with unit length. A segment that supports a balance goal does so with the lowest
// face, at rest, of each of its boxes; without boxes with its touch point and sites.
Result<Spring> resolve_payload(const GoalPayload& payload, const BodyTree& tree);

}  // namespace posed
