#include "server/tracker/owners.h"

#include <algorithm>

namespace posed::tracker {

Owners& Owners::of_process() {
  static Owners owners;
  return owners;
}

bool Owners::anothers(const Port* who, const DevicePlace& device) const {
  const std::lock_guard lock(mutex_);
  return std::any_of(devices_.begin(), devices_.end(), [&](const auto& entry) {
    return entry.first != who && !entry.second.empty() && device.is(entry.second);
  });
}

bool Owners::own(const Port* who, const DevicePlace& device) const {
  const std::lock_guard lock(mutex_);
  const auto found = devices_.find(who);
  return found != devices_.end() && !found->second.empty() && device.is(found->second);
}

void Owners::take(const Port* who, const std::string& device) {
  const std::lock_guard lock(mutex_);
  devices_[who] = device;
}

void Owners::forget(const Port* who) {
  const std::lock_guard lock(mutex_);
  devices_.erase(who);
}

}  // namespace posed::tracker
