// What a device has been asked to do differently, from the station's thread to its driver's. What nobody has asked for
// stays as somebody has made it in the device.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "server/tracker/settings.h"

namespace posed::tracker {

struct Preferences {
  std::optional<double> rate_hz;
  std::optional<std::vector<int>> stations;  // empty: all that are plugged in
  std::map<int, Vec3> hemispheres;           // by station; 0: of all
  std::optional<FilterSetting> position_filter, attitude_filter;
};

class PreferenceBox {
 public:
  // Null, and a reset of what had been asked for, is `defaults`.
  void take(const Settings& settings, const Preferences& defaults);
  Preferences get() const;
  std::uint64_t version() const { return version_; }  // grows with each change

 private:
  mutable std::mutex mutex_;
  Preferences preferences_;
  std::atomic<std::uint64_t> version_{0};
};

}  // namespace posed::tracker
