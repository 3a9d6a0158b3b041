#include "client/cli/view/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace posed::view {
namespace {

std::string number(const char* pattern, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

std::string plain(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

std::string metres_text(double metres) {
  if (std::abs(metres) >= 0.9995) return number("%.2f m", metres);
  return number(std::abs(metres) < 0.09995 ? "%.1f mm" : "%.0f mm", metres * 1e3);
}

std::string weight_text(const GoalWeight& weight) {
  const std::string text = number("%.3g", weight.value);
  return weight.orientation ? text + "/" + number("%.3g", *weight.orientation) : text;
}

std::string goal_name(const std::string& id) {
  if (std::count(id.begin(), id.end(), '.') != 2) return plain(id);
  const std::size_t from = id.find('.') + 1;
  return plain(id.substr(from, id.rfind('.') - from));
}

std::string cause_text(const proto::GoalFrame::Because& cause) {
  const std::string whose = cause.figure.empty() ? "" : cause.figure + "'s ";
  if (!cause.goal.empty()) return "held by " + goal_name(cause.goal);
  if (!cause.pin.empty()) return "held by the pin of " + whose + plain(cause.pin);
  if (cause.limit.empty()) return metres_text(cause.beyond_m) + " beyond reach";
  return whose + plain(cause.limit) + " at its limit";
}

std::string causes_text(const std::vector<proto::GoalFrame::Because>& causes) {
  std::string text;
  for (const auto& cause : causes) {
    const std::string one = cause_text(cause);
    // A joint may be at two of its limits; once said is enough.
    if (text.find(one) == std::string::npos) text += (text.empty() ? "" : "; ") + one;
  }
  return text;
}

}  // namespace posed::view
