#include "server/tracker/preferences.h"

namespace posed::tracker {
namespace {

template <class T>
void take_one(std::optional<T>& preference, const Patched<T>& said, bool reset, const std::optional<T>& fallback) {
  if (said.is_reset() || (reset && preference)) preference = fallback;
  if (said.value()) preference = *said.value();
}

}  // namespace

void PreferenceBox::take(const Settings& settings, const Preferences& defaults) {
  if (settings.empty()) return;
  const std::lock_guard lock(mutex_);
  Preferences& p = preferences_;
  take_one(p.rate_hz, settings.rate_hz, settings.reset, defaults.rate_hz);
  take_one(p.stations, settings.stations, settings.reset, defaults.stations);
  take_one(p.position_filter, settings.position_filter, settings.reset, defaults.position_filter);
  take_one(p.attitude_filter, settings.attitude_filter, settings.reset, defaults.attitude_filter);
  if (settings.reset && !p.hemispheres.empty()) p.hemispheres = defaults.hemispheres;
  for (const auto& [station, zenith] : settings.hemispheres) p.hemispheres[station] = zenith;
  ++version_;
}

Preferences PreferenceBox::get() const {
  const std::lock_guard lock(mutex_);
  return preferences_;
}

}  // namespace posed::tracker
