#include "common/goal.h"

#include <algorithm>
#include <cmath>

namespace posed {
namespace {

const char* example_of(GoalKind kind) {
  switch (kind) {
    case GoalKind::position:
    case GoalKind::pose:
      return R"("position":[x,y,z] in metres)";
    case GoalKind::orientation:
      return R"("orientation":{"quat_xyzw":[x,y,z,w]})";
    case GoalKind::aim:
      return R"("aim":{"axis":[x,y,z],"point":[x,y,z]})";
    case GoalKind::plane:
      return R"("plane":{"point":[x,y,z],"normal":[x,y,z]})";
    case GoalKind::line:
      return R"("line":{"point":[x,y,z],"direction":[x,y,z]})";
    case GoalKind::distance:
      return R"("distance":{"to":"left_hand","length":0.3})";
    case GoalKind::balance:
      return R"("balance":{"support":["left_foot","right_foot"]})";
    case GoalKind::posture:
      return R"("posture":{"pose":"rest"})";
  }
  return "";
}

// `field`: of position and orientation, the one that a pose lacks.
Error missing(GoalKind kind, GoalKind field) {
  return {"missing_field", std::string("the ") + name_of(kind) + " goal has no " + name_of(field),
          std::string("/") + name_of(field), example_of(field)};
}

// The kinds whose payload is named; both halves of a pose are one.
std::vector<GoalKind> named(const PayloadEdit& e) {
  std::vector<GoalKind> kinds;
  if (e.position || e.orientation) {
    kinds.push_back(!e.orientation ? GoalKind::position : e.position ? GoalKind::pose : GoalKind::orientation);
  }
  if (e.aim) kinds.push_back(GoalKind::aim);
  if (e.plane) kinds.push_back(GoalKind::plane);
  if (e.line) kinds.push_back(GoalKind::line);
  if (e.distance) kinds.push_back(GoalKind::distance);
  if (e.balance) kinds.push_back(GoalKind::balance);
  if (e.posture) kinds.push_back(GoalKind::posture);
  return kinds;
}

bool is_place(GoalKind kind) {
  return kind == GoalKind::position || kind == GoalKind::orientation || kind == GoalKind::pose;
}

// Position, orientation or both, each from the edit or else from what was.
Result<GoalPayload> place(GoalKind kind, const GoalPayload* before, const PayloadEdit& e) {
  std::optional<Vec3> position = e.position;
  std::optional<Quat> rotation;
  if (e.orientation) rotation = e.orientation->rotation;
  if (before && !position) {
    if (const Vec3* was = position_of(*before)) position = *was;
  }
  if (before && !rotation) {
    if (const auto* was = std::get_if<PoseTarget>(before)) rotation = was->rotation;
    if (const auto* was = std::get_if<OrientationTarget>(before)) rotation = was->rotation;
  }
  if (kind != GoalKind::orientation && !position) return missing(kind, GoalKind::position);
  if (kind != GoalKind::position && !rotation) return missing(kind, GoalKind::orientation);
  if (kind == GoalKind::position) return GoalPayload(PositionTarget{*position});
  if (kind == GoalKind::orientation) return GoalPayload(OrientationTarget{*rotation});
  return GoalPayload(PoseTarget{*position, *rotation});
}

template <class T>
Result<GoalPayload> whole(GoalKind kind, const GoalPayload* before, const std::optional<T>& given) {
  if (given) return GoalPayload(*given);
  if (before && kind_of(*before) == kind) return *before;
  return missing(kind, kind);
}

}  // namespace

const Vec3* position_of(const GoalPayload& payload) {
  if (const auto* p = std::get_if<PositionTarget>(&payload)) return &p->position;
  if (const auto* p = std::get_if<PoseTarget>(&payload)) return &p->position;
  return nullptr;
}
Vec3* position_of(GoalPayload& payload) {
  return const_cast<Vec3*>(position_of(std::as_const(payload)));
}
const Quat* rotation_of(const GoalPayload& payload) {
  if (const auto* o = std::get_if<OrientationTarget>(&payload)) return &o->rotation;
  if (const auto* p = std::get_if<PoseTarget>(&payload)) return &p->rotation;
  return nullptr;
}
Quat* rotation_of(GoalPayload& payload) {
  return const_cast<Quat*>(rotation_of(std::as_const(payload)));
}

Result<GoalPayload> payload_after(const GoalPayload* before, const PayloadEdit& e) {
  const std::vector<GoalKind> kinds = named(e);
  if (kinds.size() > 1) {
    return Error{
        "invalid_params",
        std::string("the goal is given the payloads of two kinds, ") + name_of(kinds[0]) + " and " + name_of(kinds[1]),
        std::string("/") + name_of(kinds[1]), "leave one out, or make two goals"};
  }
  // Half of a pose moves a pose, unless the kind says otherwise.
  const bool half = before && kind_of(*before) == GoalKind::pose && !kinds.empty() && is_place(kinds[0]);
  GoalKind kind = GoalKind::position;
  if (e.kind)
    kind = *e.kind;
  else if (half)
    kind = GoalKind::pose;
  else if (!kinds.empty())
    kind = kinds[0];
  else if (before)
    kind = kind_of(*before);

  const bool agrees = kinds.empty() || kinds[0] == kind || (kind == GoalKind::pose && is_place(kinds[0]));
  if (!agrees) {
    return Error{"invalid_params",
                 std::string("the kind is ") + name_of(kind) + ", but the payload is that of " + name_of(kinds[0]),
                 "/kind", std::string("say \"") + name_of(kinds[0]) + "\", or leave it out"};
  }
  switch (kind) {
    case GoalKind::position:
    case GoalKind::orientation:
    case GoalKind::pose:
      return place(kind, before, e);
    case GoalKind::aim:
      return whole(kind, before, e.aim);
    case GoalKind::plane:
      return whole(kind, before, e.plane);
    case GoalKind::line:
      return whole(kind, before, e.line);
    case GoalKind::distance:
      return whole(kind, before, e.distance);
    case GoalKind::balance:
      return whole(kind, before, e.balance);
    case GoalKind::posture:
      return whole(kind, before, e.posture);
  }
  return missing(kind, kind);
}

PayloadEdit spelled_out(const GoalPayload& payload) {
  PayloadEdit e;
  e.kind = kind_of(payload);
  if (const Vec3* position = position_of(payload)) e.position = *position;
  if (const auto* p = std::get_if<OrientationTarget>(&payload)) e.orientation = *p;
  if (const auto* p = std::get_if<PoseTarget>(&payload)) e.orientation = OrientationTarget{p->rotation};
  if (const auto* p = std::get_if<AimTarget>(&payload)) e.aim = *p;
  if (const auto* p = std::get_if<PlaneTarget>(&payload)) e.plane = *p;
  if (const auto* p = std::get_if<LineTarget>(&payload)) e.line = *p;
  if (const auto* p = std::get_if<DistanceTarget>(&payload)) e.distance = *p;
  if (const auto* p = std::get_if<BalanceTarget>(&payload)) e.balance = *p;
  if (const auto* p = std::get_if<PostureTarget>(&payload)) e.posture = *p;
  return e;
}

double over_tolerance(const GoalTolerance& tolerance, const Vec3& off, double least) {
  if (!tolerance.box) return glm::length(off) / std::max(tolerance.radius, least);
  double most = 0.0;
  for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(off[k]) / std::max((*tolerance.box)[k], least));
  return most;
}

}  // namespace posed
