// Goals as documents of the scene (paper, "Positioning by constraints"). Plain values. Points and directions are in the
// frame that the goal is relative to, in metres, unless said; directions have any length but none, quaternions
// length 1.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/math.h"
#include "common/patched.h"
#include "common/result.h"

namespace posed {

// Where on a figure a goal takes hold: a segment's touch point, a point of it, or a named site.
struct Attachment {
  std::string segment;        // empty for a bare site
  std::optional<Vec3> point;  // segment's frame
  std::string site;           // "right_hand/fingertip" names segment right_hand and site fingertip
  bool empty() const { return segment.empty() && site.empty(); }
  bool operator==(const Attachment&) const = default;
};

// ---- what a goal asks for: one kind a goal -----------------------------------------------------------------------

struct PositionTarget {
  Vec3 position{0.0, 0.0, 0.0};
};
struct OrientationTarget {
  Quat rotation{1.0, 0.0, 0.0, 0.0};  // base_from_segment
};
struct PoseTarget {
  Vec3 position{0.0, 0.0, 0.0};
  Quat rotation{1.0, 0.0, 0.0, 0.0};
};
struct AimTarget {
  Vec3 axis{1.0, 0.0, 0.0};              // segment's frame
  std::optional<Vec3> point, direction;  // one of the two
};
struct PlaneTarget {
  enum class Side { on, above };
  Vec3 point{0.0, 0.0, 0.0};
  Vec3 normal{0.0, 0.0, 1.0};
  Side side = Side::on;  // above: where the normal points to
};
struct LineTarget {
  Vec3 point{0.0, 0.0, 0.0};
  Vec3 direction{1.0, 0.0, 0.0};
};
struct DistanceTarget {
  enum class Compare { equal, at_least, at_most };
  Attachment to;  // on the same figure
  double length = 0.0;
  Compare compare = Compare::equal;
};
struct BalanceTarget {
  std::vector<Attachment> support;
  double margin = 0.0;
};
// A joint's share of q; or its orientation (rad), where what is left out is 0.
struct JointValue {
  std::vector<double> share;
  std::optional<double> halfplane, deviation, twist;
  bool oriented() const { return halfplane || deviation || twist; }
};
struct PostureTarget {
  std::string pose;  // "rest" or "start"; empty: `joints`
  std::map<std::string, JointValue> joints;
};

using GoalPayload = std::variant<PositionTarget, OrientationTarget, PoseTarget, AimTarget, PlaneTarget, LineTarget,
                                 DistanceTarget, BalanceTarget, PostureTarget>;
enum class GoalKind { position, orientation, pose, aim, plane, line, distance, balance, posture };  // in that order
inline constexpr std::array kGoalKindNames{"position", "orientation", "pose",    "aim",    "plane",
                                           "line",     "distance",    "balance", "posture"};
static_assert(kGoalKindNames.size() == std::variant_size_v<GoalPayload>);

inline GoalKind kind_of(const GoalPayload& payload) {
  return static_cast<GoalKind>(payload.index());
}
inline const char* name_of(GoalKind kind) {
  return kGoalKindNames[static_cast<std::size_t>(kind)];
}
// Balance and posture are of the figure as a whole.
inline constexpr bool takes_hold(GoalKind kind) {
  return kind != GoalKind::balance && kind != GoalKind::posture;
}
// Distance too has nothing that could lie in another frame.
inline constexpr bool has_frame(GoalKind kind) {
  return takes_hold(kind) && kind != GoalKind::distance;
}
// Of position and pose goals; else null.
const Vec3* position_of(const GoalPayload& payload);
Vec3* position_of(GoalPayload& payload);
// Of orientation and pose goals; else null.
const Quat* rotation_of(const GoalPayload& payload);
Quat* rotation_of(GoalPayload& payload);

// ---- the goal ----------------------------------------------------------------------------------------------------

// The frame that a goal's payload is in, or a camera.
struct GoalBase {
  enum class Kind { world, segment, sensor, object } kind = Kind::world;
  std::string figure, segment;  // figure empty: a goal's own
  std::string sensor;           // "liberty:1"
  std::string object{};
  bool operator==(const GoalBase&) const = default;
};

// 0 is off.
struct GoalWeight {
  GoalWeight(double both = 10.0) : value(both) {}
  double value;
  std::optional<double> orientation;  // of a pose goal, where it differs from its position's
  bool operator==(const GoalWeight&) const = default;
};

// How near is near enough: a radius, or for a position a box, half its sides along the axes of `relative_to`.
struct GoalTolerance {
  GoalTolerance(double within = 0.0) : radius(within) {}
  explicit GoalTolerance(const Vec3& sides) : radius(0.0), box(sides) {}
  double radius;  // m
  std::optional<Vec3> box;
  bool operator==(const GoalTolerance&) const = default;
};

// `off` (m, in those axes) in multiples of what is tolerated, of `least` m at least: up to 1 it is near enough.
double over_tolerance(const GoalTolerance& tolerance, const Vec3& off, double least);

struct Goal {
  std::string id;
  std::string figure;
  Attachment at;  // empty for kinds that take no hold
  GoalPayload payload;
  GoalBase relative_to;
  GoalWeight weight;
  int priority = 0;  // -100 to 100; lower is met first
  GoalTolerance tolerance;
  bool enabled = true;
  std::string label;
  std::string user;  // JSON text of at most 4 KiB, kept verbatim; empty: none
};

// What an edit says of the payload. Position and orientation are two fields, each of which a pose goal keeps when only
// the other is named; the payloads of all other kinds are one field each.
struct PayloadEdit {
  std::optional<GoalKind> kind;
  std::optional<Vec3> position;
  std::optional<OrientationTarget> orientation;
  std::optional<AimTarget> aim;
  std::optional<PlaneTarget> plane;
  std::optional<LineTarget> line;
  std::optional<DistanceTarget> distance;
  std::optional<BalanceTarget> balance;
  std::optional<PostureTarget> posture;
};

// The payload that an edit leads to. `before`: of the goal that is edited; null: it is new.
// Errors: "invalid_params" for the payloads of two kinds, or a kind that is not the payload's; "missing_field".
Result<GoalPayload> payload_after(const GoalPayload* before, const PayloadEdit& edit);
// The edit that says all of a payload, its kind too.
PayloadEdit spelled_out(const GoalPayload& payload);

struct GoalEdit : PayloadEdit {
  std::string id;      // empty: FIGURE.SEGMENT.KIND
  std::string figure;  // empty: the only figure, else "body"
  std::optional<Attachment> at;
  Patched<GoalBase> relative_to;
  Patched<GoalWeight> weight;
  Patched<int> priority;
  Patched<GoalTolerance> tolerance;
  Patched<bool> enabled;
  Patched<std::string> label;
  Patched<std::string> user;
};

}  // namespace posed
