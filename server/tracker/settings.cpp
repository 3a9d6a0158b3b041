#include "server/tracker/settings.h"

#include <algorithm>
#include <utility>

#include "server/tracker/tracker.h"

namespace posed::tracker {
namespace {

Error no_such(const std::string& kind, const Abilities& can, const char* field) {
  std::string all;
  for (const auto& [has, name] : {std::pair{!can.rates.empty(), "rate_hz"},
                                  {can.switches, "sensors"},
                                  {can.hemispheres, "hemisphere"},
                                  {can.filters, "position_filter"},
                                  {can.filters, "attitude_filter"}}) {
    if (has) all.append(all.empty() ? "it has " : ", ").append(name);
  }
  return {"not_available", "a " + kind + " has no such setting as " + field, std::string("/") + field,
          all.empty() ? "it has none" : all};
}

}  // namespace

posed::Status refuse(const Settings& settings, const std::string& kind, const Abilities& can) {
  if (settings.rate_hz.named() && can.rates.empty()) return no_such(kind, can, "rate_hz");
  if (settings.stations.named() && !can.switches) return no_such(kind, can, "sensors");
  if (!settings.hemispheres.empty() && !can.hemispheres) return no_such(kind, can, "hemisphere");
  if (settings.position_filter.named() && !can.filters) return no_such(kind, can, "position_filter");
  if (settings.attitude_filter.named() && !can.filters) return no_such(kind, can, "attitude_filter");
  if (const double* rate = settings.rate_hz.value();
      rate && std::find(can.rates.begin(), can.rates.end(), *rate) == can.rates.end()) {
    std::string rates;
    for (const double known : can.rates) rates += (rates.empty() ? "" : " or ") + std::to_string(std::lround(known));
    return Error{"out_of_range", "a " + kind + " has no such rate", "/rate_hz", rates + " Hz"};
  }
  const int most = can.stations > 0 ? can.stations : 256;
  if (const auto* stations = settings.stations.value()) {
    for (std::size_t i = 0; i < stations->size(); ++i) {
      if ((*stations)[i] > most)
        return Error{"out_of_range", "a " + kind + " has no such sensor", "/sensors/" + std::to_string(i),
                     "1 to " + std::to_string(most)};
    }
    if (stations->empty())
      return Error{"out_of_range", "a tracker without a sensor measures nothing", "/sensors", "null: all of them"};
  }
  for (const auto& [station, zenith] : settings.hemispheres) {
    if (station > most)
      return Error{"out_of_range", "a " + kind + " has no such sensor", "/hemisphere", "1 to " + std::to_string(most)};
    if (!finite(zenith) || glm::length(zenith) > 1e6)
      return Error{"out_of_range", "a hemisphere is a direction", "/hemisphere", "as in [1,0,0]"};
    if (zenith == kZero && !can.follows)
      return Error{"out_of_range", "a " + kind + " does not follow a sensor into the other half of its field",
                   "/hemisphere", "a direction, as in [1,0,0]"};
  }
  return Ok{};
}

posed::Status Tracker::configure(const Settings& settings) {
  return refuse(settings, kind(), {});
}

}  // namespace posed::tracker
