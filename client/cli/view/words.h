// Numbers and causes in plain words. Pure.
#pragma once

#include <string>

#include "proto/messages.h"

namespace posed::view {

std::string metres_text(double metres);  // "34.1 mm", "1.20 m"
std::string weight_text(const GoalWeight& weight);
std::string cause_text(const proto::GoalFrame::Because& cause);
// "held by left hand; right elbow at its limit; 12 cm beyond reach"; empty where there is none.
std::string causes_text(const std::vector<proto::GoalFrame::Because>& causes);
// A goal made without a name is called FIGURE.SEGMENT.KIND: its segment says as much.
std::string goal_name(const std::string& id);

}  // namespace posed::view
