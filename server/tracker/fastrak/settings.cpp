#include "server/tracker/fastrak/settings.h"

#include <cstdio>
#include <utility>

#include "server/tracker/axes.h"

namespace posed::tracker {

Abilities fastrak_abilities(int stations) {
  Abilities can;
  can.stations = stations;
  can.switches = can.hemispheres = can.filters = true;
  return can;
}

Preferences fastrak_defaults() {
  return {std::nullopt, std::vector<int>{}, {{0, kX}}, FilterSetting{}, FilterSetting{}};
}

std::vector<std::string> fastrak_switches(const Preferences& wish, int stations, unsigned on, unsigned found) {
  std::vector<std::string> commands;
  if (!wish.stations) return commands;
  unsigned wanted = wish.stations->empty() ? found : 0;
  for (const int station : *wish.stations) wanted |= 1u << (station - 1);
  for (int i = 0; i < stations; ++i) {
    if (((on ^ wanted) >> i & 1u) == 0) continue;
    commands.push_back("l" + std::to_string(i + 1) + ((wanted >> i & 1u) != 0 ? ",1\r" : ",0\r"));
  }
  return commands;
}

std::vector<std::string> fastrak_settings(const Preferences& wish, int stations) {
  std::vector<std::string> commands;
  char text[80];
  for (int station = 1; station <= stations; ++station) {
    auto zenith = wish.hemispheres.find(station);
    if (zenith == wish.hemispheres.end()) zenith = wish.hemispheres.find(0);
    if (zenith == wish.hemispheres.end()) continue;
    const Vec3 v = world_from_source(zenith->second);  // a half turn is its own inverse
    std::snprintf(text, sizeof text, "H%d,%.4f,%.4f,%.4f\r", station, v.x, v.y, v.z);
    commands.emplace_back(text);
  }
  for (const auto& [letter, filter] : {std::pair{'x', wish.position_filter}, {'v', wish.attitude_filter}}) {
    if (!filter) continue;
    const FilterSetting f = filter->on ? *filter : FilterSetting{false, 0.0, 1.0, 0.0, 0.0};
    std::snprintf(text, sizeof text, "%c%.3f,%.3f,%.3f,%.3f\r", letter, f.sensitivity, f.low, f.high, f.most);
    commands.emplace_back(text);
  }
  return commands;
}

}  // namespace posed::tracker
