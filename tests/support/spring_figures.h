// Figures for the spring solver's tests: all kinds of joints with their limits, chains, hands, quadrupeds.
#pragma once

#include <memory>
#include <random>

#include "server/solver/spring_goal.h"
#include "tests/support/figures.h"

namespace posed::test {

// Of each kind of joint one, in a chain: hinge about a general axis, universal, ball with a box, free ball, ball with
// an ellipse, ball with a polygon, prismatic; and a fixed one.
FigureDocument all_joints(JointType root = JointType::free);

// A tree of 2 to `most` segments of all joint types, with limits, swings and twists (some of no width), some links of
// no length, masses, and any root.
FigureDocument random_limited_figure(std::mt19937& random, int most);

FigureDocument hand_with_fingers();  // the palm floats; 5 fingers of 1 universal and 2 hinges
FigureDocument quadruped();          // 4 legs of 3 joints, neck and tail

Swing ellipse(double first, double second);
Swing polygon(std::vector<Vec3> corners);  // any lengths, counter-clockwise seen from outside

// A goal of every kind in turn, anywhere about the figures (`kind`: index in Spring); priority 0, no tolerance.
SpringGoal random_goal(std::mt19937& random, const std::vector<std::shared_ptr<const BodyTree>>& figures, int kind,
                       double reach);

inline constexpr int kKinds = static_cast<int>(std::variant_size_v<Spring>);

SpringGoal goal_at(const BodyTree& tree, const char* segment, Spring spring, double weight = 10.0);

}  // namespace posed::test
