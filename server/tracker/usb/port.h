// A family's trackers on USB, whichever of its models is plugged in. The libusb context lives on the driver's thread.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "server/tracker/port.h"
#include "server/tracker/time_source.h"
#include "server/tracker/usb/bus.h"

namespace posed::tracker {

class UsbPort final : public Port {
 public:
  // `family`: as the table of usb/models.h has it. `wanted`: a serial number, or a port as "1-2.3"; empty: one that no
  // other tracker here has had, and from then on that one.
  UsbPort(std::string family, std::string wanted, TimeSource now)
      : family_(std::move(family)), wanted_(std::move(wanted)), now_(std::move(now)) {
    Owners::of_process().take(this, wanted_);
  }
  ~UsbPort() override { Owners::of_process().forget(this); }

  Opened open(const std::function<bool()>& stopping) override;
  bool rest(std::chrono::milliseconds at_most) override;
  void interrupt() override;

 private:
  std::string family_, wanted_;
  TimeSource now_;
  std::mutex mutex_;  // of the pointer: interrupt() may come before the first open
  std::unique_ptr<UsbBus> bus_;
};

}  // namespace posed::tracker
