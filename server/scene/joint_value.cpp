#include "server/scene/joint_value.h"

#include <algorithm>

#include "common/names.h"
#include "server/solver/orientation.h"

namespace posed {
namespace {

constexpr double kMaxValue = 1e6;  // m or rad

Result<std::vector<double>> oriented_share(const Segment& segment, const JointValue& value) {
  if (!turns(segment.joint.type))
    return Error{"invalid_params", "the joint has no free orientation", "/halfplane", "set its value"};
  const Orientation o{value.halfplane.value_or(0.0), value.deviation.value_or(0.0), value.twist.value_or(0.0)};
  if (!(o.deviation >= 0.0 && o.deviation <= M_PI))
    return Error{"out_of_range", "the deviation is out of range", "/deviation", "0 to pi"};
  if (!(std::abs(o.halfplane) <= kMaxValue))
    return Error{"out_of_range", "the half-plane is out of range", "/halfplane", "radians"};
  if (!(std::abs(o.twist) <= kMaxValue)) return Error{"out_of_range", "the twist is out of range", "/twist", "radians"};
  const auto q = xyzw(quat_from_orientation(o, segment.touch_point));
  return std::vector<double>(q.begin(), q.end());
}

}  // namespace

Result<int> find_joint(const BodyTree& tree, const std::string& name) {
  if (const auto joint = tree.find_joint(name)) return *joint;
  std::vector<std::string> known;
  known.reserve(static_cast<std::size_t>(tree.size()));
  for (int i = 0; i < tree.size(); ++i) known.push_back(tree.joint(i).name);
  return Error{"unknown_joint", "no joint is called " + name.substr(0, 64), "",
               did_you_mean(name, known) + (known.size() > 24 ? " figure.get names them" : "")};
}

bool turns(JointType type) {
  return type == JointType::ball || type == JointType::universal;
}

Result<std::vector<double>> joint_share(const BodyTree& tree, int joint, const JointValue& value) {
  if (value.oriented() && !value.share.empty())
    return Error{"invalid_params", "a joint is set either by value or by halfplane, deviation and twist", "",
                 "give one of the two"};
  if (value.oriented()) return oriented_share(tree.segment(joint), value);
  const auto size = static_cast<std::size_t>(q_size(tree.joint(joint).type));
  std::vector<double> share = value.share;
  if (share.size() != size || size == 0) {
    return Error{"wrong_type", "the joint takes " + std::to_string(size) + " numbers", "",
                 "figure.get tells its type in q_layout"};
  }
  for (const double v : share) {
    if (!(std::abs(v) <= kMaxValue))
      return Error{"out_of_range", "a value of the joint is out of range", "", "radians, metres or a quaternion"};
  }
  if (size < 4) return share;
  const Quat q = quat_from_xyzw(std::span<const double>(share).last(4));
  const double length = glm::length(q);
  if (!(std::abs(length - 1.0) <= 1e-3)) {
    return Error{"invalid_params", "the quaternion is not of unit length", "", "x y z w, with x²+y²+z²+w² = 1"};
  }
  if (std::abs(length - 1.0) > 1e-15) {  // else kept to the last digit
    for (double& v : std::span<double>(share).last(4)) v /= length;
  }
  return share;
}

}  // namespace posed
