// The built-in human figure, named after the one that POSIT took from TEMPUS: 18 segments, 18 joints, 48 degrees of
// freedom, the root in the lower torso (paper, "Body representation", Figure 13).
//
// Lengths are shares of the stature (Drillis and Contini 1966 in Winter, Biomechanics and Motor Control of Human
// Movement), masses Winter's shares of a body of 70 kg at 1.75 m that grows with the cube of the stature. Ranges of
// motion: AAOS. At rest it stands in a T-pose on the floor z = 0, facing +X, all segment frames parallel to the world.
#pragma once

#include <vector>

#include "common/figure.h"
#include "common/result.h"
#include "server/solver/body_tree.h"

namespace posed {

inline constexpr double kMinStature = 0.5;  // m
inline constexpr double kMaxStature = 2.5;

// `stature` in metres, kMinStature to kMaxStature. Errors: "out_of_range", path "/stature".
// Joints: root waist neck head, and with left_ or right_: sternoclavicular shoulder elbow wrist hip knee ankle.
Result<FigureDocument> tempus(double stature);

// Standing with the arms down, 5 degrees off the body: the rest with left_shoulder and right_shoulder turned. For a
// figure without such ball joints it is the rest.
std::vector<double> start_pose(const BodyTree& tree);

}  // namespace posed
