// A station for these tests: a small figure of two segments, two goals and a chair.
#pragma once

#include "client/cli/view/station.h"

namespace posed::view::test {

inline Segment limb(const char* name, const char* parent, Vec3 at, Vec3 to, double radius) {
  Segment segment;
  segment.name = name;
  segment.parent = parent;
  segment.joint.name = std::string(name) + "_joint";
  segment.joint.parent_from_joint.position = at;
  segment.touch_point = to;
  segment.shapes = {{Shape::Kind::capsule, kZero, to, radius}};
  return segment;
}

inline Station standing() {
  Entities entities;
  proto::FigureResult figure;
  figure.document.root = "trunk";
  figure.document.segments = {limb("trunk", "", {0, 0, 0.2}, {0, 0, 1.2}, 0.15),
                              limb("left_arm", "trunk", {0, 0.2, 1.2}, {0, 0.6, 0}, 0.05)};
  figure.document.mirror = {{"left_arm", "right_arm"}};
  entities.figures.emplace("body", figure);

  proto::GoalResult hand;
  hand.goal.id = "body.left_arm.position";
  hand.goal.figure = "body";
  hand.goal.at = {"left_arm", {}, ""};
  hand.goal.payload = PositionTarget{{0.4, 0.8, 1.2}};
  proto::GoalResult stand;
  stand.goal.id = "balance";
  stand.goal.figure = "body";
  stand.goal.payload = BalanceTarget{};
  entities.goals = {stand, hand};

  proto::PoseData pose;
  pose.revision = 7;
  proto::FigurePose body;
  body.figure = "body";
  body.world_from_segment = {{{0, 0, 0.2}, quat_identity()}, {{0, 0.2, 1.4}, quat_identity()}};
  proto::GoalFrame goal;
  goal.id = "body.left_arm.position";
  goal.touch = {0, 0.8, 1.4};
  goal.target = {0.4, 0.8, 1.2};
  goal.error = 0.447;
  goal.state = GoalState::limited;
  goal.causes.resize(2);
  goal.causes[0].limit = "left_elbow";
  goal.causes[1].beyond_m = 0.12;
  body.goals = {goal};
  pose.figures = {body};

  Station station;
  station.entities = std::make_shared<const Entities>(std::move(entities));
  station.pose = std::make_shared<const proto::PoseData>(std::move(pose));
  return station;
}

}  // namespace posed::view::test
