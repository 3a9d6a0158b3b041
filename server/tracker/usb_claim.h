// The steps of opening a USB device that can go wrong in the field, and what to tell the user then.
// Source: libusb 1.0 documentation (libusb_claim_interface, libusb_set_configuration, "Caveats").
#pragma once

#include <functional>
#include <string>

#include "common/result.h"
#include "server/tracker/usb_pipe.h"

namespace posed::tracker {

// Configures the device where nobody has, and claims interface 0. A device that was announced just now may not have its
// interfaces yet: waits up to a second for them. Returns a libusb error code.
int claim_usb_interface(UsbBus& bus, libusb_device_handle* handle, const std::function<bool()>& stopping);

// The bulk pair of interface 0: `wanted` where both are there, else the first of each direction.
Result<UsbEndpoints> find_usb_endpoints(const UsbDevicePtr& device, UsbEndpoints wanted);

// `code`: of libusb_open or libusb_claim_interface. All have the code not_available; the hint is the cure.
Error usb_open_error(int code, const UsbIdentity& who);

// Who else has the device open, as "PiMgr (process 812)", from /proc; empty where that cannot be seen.
std::string usb_holder(const UsbIdentity& who);

}  // namespace posed::tracker
