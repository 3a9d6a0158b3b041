// One libusb context and the devices of one vendor on it. Owned by one thread, which also runs libusb's events here;
// interrupt() may be called from any.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/result.h"
#include "server/tracker/owners.h"

struct libusb_context;
struct libusb_device;

namespace posed::tracker {

using UsbDevicePtr = std::shared_ptr<libusb_device>;  // let go of it before its bus

struct UsbIdentity {
  std::uint16_t vendor = 0, product = 0;
  int bus = 0, address = 0;
};

class UsbBus {
 public:
  static Result<std::unique_ptr<UsbBus>> open(std::uint16_t vendor);  // Error not_available: no USB here
  ~UsbBus();
  UsbBus(const UsbBus&) = delete;
  UsbBus& operator=(const UsbBus&) = delete;

  std::vector<UsbDevicePtr> devices() const;  // those of the vendor that are there now
  void handle_events(std::chrono::milliseconds at_most);
  void interrupt();    // makes handle_events return
  bool take_change();  // whether one of the vendor's came or went since the last call

  static UsbIdentity identity(const UsbDevicePtr& device);
  // Its port as "1-2.3", as lsusb -t and sysfs have it; the serial number that it has told the kernel, if any.
  static DevicePlace place(const UsbDevicePtr& device);

 private:
  UsbBus(libusb_context* context, std::uint16_t vendor);
  static int on_hotplug(libusb_context* context, libusb_device* device, int event, void* bus);

  libusb_context* context_;
  std::uint16_t vendor_;
  bool changed_ = false;
  int hotplug_handle_ = -1;  // -1: the system announces nothing, only a look tells
};

}  // namespace posed::tracker
