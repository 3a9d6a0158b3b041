// What a tracker's device may be asked to do differently. Plain values; what is not named stays, null is the family's
// default.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/math.h"
#include "common/patched.h"
#include "common/result.h"

namespace posed::tracker {

// The device's own low pass, as Polhemus' manuals have it: how sharply it reacts, and the least and the greatest share
// of the old value.
struct FilterSetting {
  bool on = false;
  double sensitivity = 0.2, low = 0.2, high = 0.8, most = 0.95;
  bool operator==(const FilterSetting&) const = default;
};

struct Settings {
  bool reset = false;  // all of them to the family's defaults
  Patched<double> rate_hz;
  Patched<std::vector<int>> stations;  // those that are active
  std::map<int, Vec3> hemispheres;     // by station: posed's axes; zero: it follows
  Patched<FilterSetting> position_filter, attitude_filter;

  bool empty() const {
    return !reset && !rate_hz.named() && !stations.named() && hemispheres.empty() && !position_filter.named() &&
           !attitude_filter.named();
  }
};

// Which of them a family has.
struct Abilities {
  std::vector<double> rates;  // Hz; empty: it has one
  int stations = 0;           // the highest that there can be
  bool switches = false;      // stations can be switched on and off
  bool hemispheres = false;
  bool follows = false;  // a sensor from one half of the field to the other
  bool filters = false;
};
// "not_available" for the first field that it has not, and which it has; "out_of_range" for a rate or a station that it
// has not.
posed::Status refuse(const Settings& settings, const std::string& kind, const Abilities& can);

}  // namespace posed::tracker
