// A joint's value as people write it, and as q holds it.
#pragma once

#include <string>
#include <vector>

#include "common/goal.h"
#include "common/result.h"
#include "server/solver/body_tree.h"

namespace posed {

// Errors: "unknown_joint", with a hint and an empty path.
Result<int> find_joint(const BodyTree& tree, const std::string& name);

// Joints that are given by a quaternion alone.
bool turns(JointType type);

// The joint's share of q; its quaternion may be off unit length by 1e-3 and comes out exact. Errors: the path is empty
// or names a part of the value ("/deviation").
Result<std::vector<double>> joint_share(const BodyTree& tree, int joint, const JointValue& value);

}  // namespace posed
