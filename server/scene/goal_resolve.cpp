#include "server/scene/goal_resolve.h"

#include <algorithm>

#include "server/scene/errors.h"
#include "server/scene/joint_value.h"
#include "server/solver/figure_check.h"
#include "server/solver/goals/balance.h"
#include "server/solver/kinematics.h"
#include "server/solver/tempus.h"

namespace posed {
namespace {

using Maybe = std::optional<Error>;

Maybe check_point(const Vec3& point, const std::string& path, const char* what) {
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(point[i]) <= kMaxCoordinate)) {
      return Error{"out_of_range", std::string(what) + " is too far away", path + "/" + std::to_string(i),
                   "within 1000 km of the origin"};
    }
  }
  return {};
}

Result<Vec3> unit(const Vec3& direction, const std::string& path) {
  if (auto e = check_point(direction, path, "the direction")) return *e;
  const double longest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!(longest >= 1e-9))
    return Error{"out_of_range", "the direction has no length", path, "any vector but zero; its length is not used"};
  return glm::normalize(direction / longest);
}

Result<Quat> unit(const Quat& q, const std::string& path) {
  const double length = glm::length(q);
  if (!(std::abs(length - 1.0) <= kUnitQuatTolerance))
    return Error{"invalid_params", "the quaternion is not of unit length", path, "x y z w, with x²+y²+z²+w² = 1"};
  return q / length;
}

// The corners of the lowest face of a box, where the figure is at rest.
void append_sole(const Shape& box, const Transform& world_from_segment, int segment, std::vector<AttachedPoint>& out) {
  const Vec3 down = glm::conjugate(world_from_segment.rotation) * -kZ;
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(down[k]) > std::abs(down[axis])) axis = k;
  }
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (const auto& [su, sv] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    Vec3 corner = box.a;
    corner[axis] += down[axis] < 0.0 ? -box.b[axis] : box.b[axis];
    corner[u] += su * box.b[u];
    corner[v] += sv * box.b[v];
    out.push_back({segment, corner});
  }
}

void append_support(int segment, const BodyTree& tree, std::vector<AttachedPoint>& out) {
  std::vector<Transform> world(static_cast<std::size_t>(tree.size()));
  forward_kinematics(tree, tree.rest(), world);
  const std::size_t before = out.size();
  for (const Shape& shape : tree.segment(segment).shapes) {
    if (shape.kind == Shape::Kind::box) append_sole(shape, world[static_cast<std::size_t>(segment)], segment, out);
  }
  if (out.size() > before) return;
  out.push_back({segment, tree.segment(segment).touch_point});
  for (const auto& [name, site] : tree.document().sites) {
    if (site.segment == tree.segment(segment).name) out.push_back({segment, site.point});
  }
}

class Resolver {
 public:
  explicit Resolver(const BodyTree& tree) : tree_(tree) {}

  Result<Spring> operator()(const PositionTarget& t) const {
    if (auto e = check_point(t.position, "/position", "the position")) return *e;
    return Spring(PositionSpring{t.position});
  }
  Result<Spring> operator()(const OrientationTarget& t) const {
    const Result<Quat> rotation = unit(t.rotation, "/orientation/quat_xyzw");
    if (!rotation) return rotation.error();
    return Spring(OrientationSpring{*rotation});
  }
  Result<Spring> operator()(const PoseTarget& t) const {
    if (auto e = check_point(t.position, "/position", "the position")) return *e;
    const Result<Quat> rotation = unit(t.rotation, "/orientation/quat_xyzw");
    if (!rotation) return rotation.error();
    return Spring(PoseSpring{t.position, *rotation});
  }
  Result<Spring> operator()(const AimTarget& t) const {
    if (t.point && t.direction)
      return Error{"invalid_params", "the goal aims at a point and along a direction", "/aim/direction",
                   "leave one of the two out"};
    if (!t.point && !t.direction)
      return Error{"missing_field", "the goal aims at nothing", "/aim/point",
                   R"("point":[x,y,z] or "direction":[x,y,z])"};
    const Result<Vec3> axis = unit(t.axis, "/aim/axis");
    if (!axis) return axis.error();
    if (t.point) {
      if (auto e = check_point(*t.point, "/aim/point", "the point")) return *e;
      return Spring(AimSpring{*axis, true, *t.point});
    }
    const Result<Vec3> direction = unit(*t.direction, "/aim/direction");
    if (!direction) return direction.error();
    return Spring(AimSpring{*axis, false, *direction});
  }
  Result<Spring> operator()(const PlaneTarget& t) const {
    if (auto e = check_point(t.point, "/plane/point", "the point")) return *e;
    const Result<Vec3> normal = unit(t.normal, "/plane/normal");
    if (!normal) return normal.error();
    return Spring(PlaneSpring{t.point, *normal, t.side == PlaneTarget::Side::above});
  }
  Result<Spring> operator()(const LineTarget& t) const {
    if (auto e = check_point(t.point, "/line/point", "the point")) return *e;
    const Result<Vec3> direction = unit(t.direction, "/line/direction");
    if (!direction) return direction.error();
    return Spring(LineSpring{t.point, *direction});
  }
  Result<Spring> operator()(const DistanceTarget& t) const {
    const Result<AttachedPoint> to = resolve_place(t.to, tree_, "/distance/to");
    if (!to) return to.error();
    if (!(t.length >= 0.0 && t.length <= kMaxCoordinate))
      return Error{"out_of_range", "the length is out of range", "/distance/length", "0 or more, in metres"};
    constexpr DistanceSpring::Compare kCompare[] = {DistanceSpring::Compare::equal, DistanceSpring::Compare::at_least,
                                                    DistanceSpring::Compare::at_most};
    return Spring(DistanceSpring{*to, t.length, kCompare[static_cast<std::size_t>(t.compare)]});
  }
  Result<Spring> operator()(const BalanceTarget& t) const {
    if (t.support.empty() || t.support.size() > kMaxSupport) {
      return Error{"out_of_range",
                   t.support.empty() ? "the goal has no support to stand on" : "the goal has too many supports",
                   "/balance/support", R"(1 to 32 places, as in ["left_foot","right_foot"])"};
    }
    if (!(t.margin >= 0.0 && t.margin <= kMaxLength))
      return Error{"out_of_range", "the margin is out of range", "/balance/margin", "0 or more, in metres"};
    BalanceSpring spring;
    spring.margin = t.margin;
    for (std::size_t i = 0; i < t.support.size(); ++i) {
      const Attachment& at = t.support[i];
      const Result<AttachedPoint> place = resolve_place(at, tree_, "/balance/support/" + std::to_string(i));
      if (!place) return place.error();
      if (at.point || !at.site.empty())
        spring.support.push_back(*place);
      else
        append_support(place->segment, tree_, spring.support);
    }
    if (spring.support.size() > springs::kMostSupports) {
      return Error{"out_of_range",
                   "the supports have " + std::to_string(spring.support.size()) + " points, at most " +
                       std::to_string(springs::kMostSupports) + " can count",
                   "/balance/support", R"(name fewer, or one point of each: {"segment":"paw","point":[0,0,0]})"};
    }
    return Spring(std::move(spring));
  }
  Result<Spring> operator()(const PostureTarget& t) const {
    if (t.pose.empty() == t.joints.empty()) {
      return t.pose.empty() ? Error{"missing_field", "the posture is empty", "/posture/pose",
                                    R"("pose":"rest" or "joints":{"left_elbow":{"deviation":1.2}})"}
                            : Error{"invalid_params", "the posture is a whole pose and joints too", "/posture/joints",
                                    "leave one of the two out"};
    }
    return t.pose.empty() ? joints(t) : whole_pose(t.pose);
  }

 private:
  Result<Spring> whole_pose(const std::string& name) const {
    if (name != "rest" && name != "start")
      return Error{"invalid_params", "no pose is called " + name.substr(0, 64), "/posture/pose", "rest or start"};
    const std::vector<double> q = name == "rest" ? tree_.rest() : start_pose(tree_);
    PostureSpring spring;
    for (int i = 0; i < tree_.size(); ++i) {
      if (!bends(i)) continue;
      spring.joints.push_back(i);
      const auto first = q.begin() + tree_.q_at(i);
      spring.values.insert(spring.values.end(), first, first + q_size(tree_.joint(i).type));
    }
    return Spring(std::move(spring));
  }

  // In the order of the figure's segments, so that the same posture is the same spring.
  Result<Spring> joints(const PostureTarget& t) const {
    std::map<int, std::vector<double>> shares;
    for (const auto& [name, value] : t.joints) {
      const std::string path = "/posture/joints/" + token(name);
      const Result<int> joint = find_joint(tree_, name);
      if (!joint) return below(path, joint.error());
      if (!bends(*joint)) {
        return Error{"invalid_params", "joint " + name + " does not bend", path,
                     "leave it out; a pose goal places the root"};
      }
      const Result<std::vector<double>> share = joint_share(tree_, *joint, value);
      if (!share) return below(path, share.error());
      shares.emplace(*joint, *share);
    }
    PostureSpring spring;
    for (const auto& [joint, share] : shares) {
      spring.joints.push_back(joint);
      spring.values.insert(spring.values.end(), share.begin(), share.end());
    }
    return Spring(std::move(spring));
  }

  bool bends(int joint) const {
    const JointType type = tree_.joint(joint).type;
    return type != JointType::free && type != JointType::fixed;
  }

  const BodyTree& tree_;
};

}  // namespace

Result<AttachedPoint> resolve_place(const Attachment& at, const BodyTree& tree, const std::string& path) {
  Result<AttachedPoint> place = tree.attach(at);
  if (!place) return below(path, place.error());
  for (int i = 0; i < 3; ++i) {
    if (at.point && !(std::abs((*at.point)[i]) <= kMaxLength)) {
      return Error{"out_of_range", "the point is too far from its segment", path + "/point/" + std::to_string(i),
                   "within 10000 m, in the segment's frame"};
    }
  }
  return place;
}

Result<Spring> resolve_payload(const GoalPayload& payload, const BodyTree& tree) {
  return std::visit(Resolver(tree), payload);
}

}  // namespace posed
