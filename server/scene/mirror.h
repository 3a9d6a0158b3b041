// The pose of a figure as a mirror shows it: left and right change places across the figure's own plane y = 0.
#pragma once

#include <span>
#include <vector>

#include "server/solver/body_tree.h"

namespace posed {

// Joints of the segments that the figure's document pairs under "mirror" swap; the others, the root's turn about Z and
// X among them, are reflected. The root keeps its position. Segment frames must be parallel at rest, as tempus's are.
std::vector<double> mirrored(const BodyTree& tree, std::span<const double> q);

}  // namespace posed
