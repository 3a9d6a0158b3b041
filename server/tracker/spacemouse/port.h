// A SpaceMouse through hidraw, opened for reading alone and beside all others: its LED, and programs that also read it,
// stay as they are.
// Source: the kernel's hidraw documentation (a read is one report); HID usage tables (multi-axis controller); product
// ids as spacenavd and PySpaceMouse have them.
#pragma once

#include <memory>
#include <string>

#include "server/tracker/port.h"
#include "server/tracker/time_source.h"

namespace posed::tracker {

struct HidrawPaths {
  std::string nodes = "/dev";                      // hidraw0 ...
  std::string descriptions = "/sys/class/hidraw";  // hidraw0/device/uevent ...
};

class SpacemousePort final : public Port {
 public:
  // `wanted`: as of UsbPort; its port is as the kernel tells it of HID, "usb-0000:00:14.0-2".
  explicit SpacemousePort(TimeSource now, std::string wanted = "", HidrawPaths paths = {});
  ~SpacemousePort() override;

  Opened open(const std::function<bool()>& stopping) override;
  bool rest(std::chrono::milliseconds at_most) override;
  void interrupt() override;

 private:
  struct Loop;
  TimeSource now_;
  std::string wanted_;
  HidrawPaths paths_;
  std::unique_ptr<Loop> loop_;
};

}  // namespace posed::tracker
