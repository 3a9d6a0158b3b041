// What became of each goal, and why (paper: "d2 = 4 d1"; common/pose.h: GoalReport).
#pragma once

#include <span>
#include <vector>

#include "common/pose.h"
#include "server/solver/body_tree.h"
#include "server/solver/reach_goal.h"
#include "server/solver/reach_tree.h"

namespace posed {

inline constexpr double kReached = 1e-3;      // m; a goal's own tolerance counts where it is larger
inline constexpr std::size_t kMaxCauses = 8;  // goals named as causes of one goal, the strongest opponents first

// `node_of_segment`: the reach tree's node of each segment, or -1. Fills `out`, one report a goal in the goals' order:
//   off          weight 0 or disabled
//   reached      the error is within the tolerance or 1 mm
//   unreachable  it pulls, and nothing that may move can bring it nearer: the root can not be translated, and each
//                joint on its way to the root has the target straight behind or before its lever
//   balanced     else; causes: goals whose force opposes its own
// Cause beyond: the chain from the reach tree's parent node is straight and the target lies so far beyond its end.
// Does not allocate once `out` has held as many goals.
void report_goals(const BodyTree& tree, const ReachTree& reach, std::span<const int> node_of_segment,
                  std::span<const ReachGoal> goals, std::span<const Transform> world_from_segment,
                  std::vector<GoalReport>& out);

}  // namespace posed
