// Which device each port of this process has had last, so that two trackers of a kind keep theirs over re-plugs,
// whichever is plugged in first. Thread-safe.
#pragma once

#include <map>
#include <mutex>
#include <string>

namespace posed::tracker {

class Port;

// What tells a device from others of its kind, as the system has it: its serial number where it says one, else the port
// that it is plugged in at.
struct DevicePlace {
  std::string serial, port;
  const std::string& name() const { return serial.empty() ? port : serial; }
  // Whether it is the one that was asked for; empty: any.
  bool is(const std::string& wanted) const { return wanted.empty() || wanted == serial || wanted == port; }
};

class Owners {
 public:
  static Owners& of_process();

  bool anothers(const Port* who, const DevicePlace& device) const;
  bool own(const Port* who, const DevicePlace& device) const;
  // By its serial number or its port; and none that it had before. Whoever asks for one by name takes it beforehand.
  void take(const Port* who, const std::string& device);
  void forget(const Port* who);

 private:
  mutable std::mutex mutex_;
  std::map<const Port*, std::string> devices_;
};

}  // namespace posed::tracker
