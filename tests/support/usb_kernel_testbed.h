// An emulated tracker at a real kernel's USB stack: its virtual host controller (vhci) enumerates it, usbfs carries its
// bytes, udev makes its node. For a kernel of one's own (tests/kernel), as root there. Thread-safe.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "tests/support/tracker_testbed.h"
#include "tests/support/usb_options.h"
#include "tests/support/usbip_device.h"

namespace posed::test {

class UsbKernelTestbed final : public TrackerTestbed {
 public:
  // Null, with the reason, where there is no vhci to write to.
  static std::unique_ptr<UsbKernelTestbed> make(UsbTestbedOptions options, std::string& reason);
  ~UsbKernelTestbed() override;

  std::string place() const override { return "usb"; }
  void plug() override;  // until udev knows of it
  void pull() override;  // until the port is free again
  bool held() const override;
  void inject(std::string bytes) override;
  std::string node() const;  // /dev/bus/usb/BBB/DDD; empty where it is not plugged in

 private:
  explicit UsbKernelTestbed(UsbTestbedOptions options);
  void carry(const TrackerEmulator::Output& output) override;
  bool ready() override;
  void serve(int socket);
  void send(const UsbipDevice::Bytes& bytes);

  UsbTestbedOptions options_;
  UsbipDevice device_;
  std::mutex socket_mutex_;  // of socket_, while it is written to
  int socket_ = -1, port_ = -1;
  std::thread server_;
};

}  // namespace posed::test
