// A LIBERTY on USB: finds it, starts it, keeps it going, finds it again. One thread of its own, which holds the libusb
// context; only Frames and Statuses leave it. What goes wrong is told in the Status, with the cure, and tried again.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "server/tracker/time_source.h"
#include "server/tracker/tracker.h"

namespace posed::tracker {

class UsbBus;
class StatusBoard;

struct LibertyDriverOptions {
  std::string id = "liberty";
  // The half of the field in which the sensors are: its zenith, world axes. Unset: as the device has it (its forward
  // half from the factory). A sensor beyond the boundary is reported mirrored, not as out of range.
  std::optional<Vec3> hemisphere;
};

class LibertyDriver final : public Tracker {
 public:
  LibertyDriver(LibertyDriverOptions options, TimeSource now);
  ~LibertyDriver() override;

  const std::string& id() const override { return options_.id; }
  const std::string& kind() const override;
  void start(Sink sink) override;
  void stop() override;

 private:
  void run(Sink sink);
  void serve(UsbBus& bus, StatusBoard& board);
  bool try_devices(UsbBus& bus, StatusBoard& board);
  void rest(UsbBus& bus, StatusBoard& board);

  LibertyDriverOptions options_;
  TimeSource now_;
  std::atomic<bool> stopping_{false};
  std::mutex mutex_;       // of bus_
  UsbBus* bus_ = nullptr;  // the thread's own while it runs, for interrupt() alone
  std::thread thread_;
};

}  // namespace posed::tracker
