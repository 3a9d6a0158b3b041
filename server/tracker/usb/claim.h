// The steps of opening a USB device that can go wrong in the field, and what to tell the user then.
// Source: libusb 1.0 documentation (libusb_claim_interface, libusb_set_configuration, "Caveats").
#pragma once

#include <functional>
#include <string>

#include "common/result.h"
#include "server/tracker/usb/pipe.h"

namespace posed::tracker {

// Configures the device where nobody has, and claims the interface. A device that was announced just now may not have
// its interfaces yet: waits up to a second for them. Returns a libusb error code.
int claim_usb_interface(UsbBus& bus, libusb_device_handle* handle, int interface,
                        const std::function<bool()>& stopping);

// The first interface that has a pair: `wanted` where they are there, else the first of each direction, bulk before
// interrupt. Without `wanted.stream` there is no stream endpoint.
Result<UsbEndpoints> find_usb_endpoints(const UsbDevicePtr& device, UsbAddresses wanted);

// `code`: of libusb_open or libusb_claim_interface. All have the code not_available; the hint is the cure.
Error usb_open_error(int code, const UsbIdentity& who);

// Who else has the device open, as "PiMgr (process 812)", from /proc; empty where that cannot be seen.
std::string usb_holder(const UsbIdentity& who);

}  // namespace posed::tracker
