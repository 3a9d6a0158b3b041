#include "server/tracker/usb/claim.h"

#include <libusb.h>

#include <chrono>
#include <cstdio>
#include <memory>

#include "server/tracker/holder.h"

namespace posed::tracker {
namespace {

constexpr auto kPatience = std::chrono::seconds(1);
constexpr auto kPause = std::chrono::milliseconds(5);

int claim_once(libusb_device_handle* handle, int interface) {
  int configuration = 0;
  if (const int code = libusb_get_configuration(handle, &configuration); code != LIBUSB_SUCCESS) return code;
  if (configuration == 0) {
    // Setting one that is set already would reset the device, so this is done only where there is none.
    if (const int code = libusb_set_configuration(handle, 1); code != LIBUSB_SUCCESS) return code;
  }
  const int code = libusb_claim_interface(handle, interface);
  // A generic kernel driver (usbserial, told to) may sit on it; another program must not be pushed off.
  if (code != LIBUSB_ERROR_BUSY || libusb_kernel_driver_active(handle, interface) != 1) return code;
  libusb_detach_kernel_driver(handle, interface);
  return libusb_claim_interface(handle, interface);
}

std::string node_of(const UsbIdentity& who) {
  char text[40];
  std::snprintf(text, sizeof text, "/dev/bus/usb/%03d/%03d", who.bus, who.address);
  return text;
}

std::string name_of(const UsbIdentity& who) {
  char text[16];
  std::snprintf(text, sizeof text, "%04x:%04x", who.vendor, who.product);
  return "the USB device " + std::string(text) + " (" + node_of(who) + ")";
}

// Lower is better; `wish` is what the model is known to use.
int rank(const UsbEndpoint& endpoint, std::uint8_t wish) {
  if (endpoint.address == 0) return 3;
  if (endpoint.address == wish) return 0;
  return endpoint.interrupt ? 2 : 1;
}

UsbEndpoints endpoints_of(const libusb_interface_descriptor& face, UsbAddresses wanted) {
  UsbEndpoints found;
  found.interface = face.bInterfaceNumber;
  for (int i = 0; i < face.bNumEndpoints; ++i) {
    const libusb_endpoint_descriptor& described = face.endpoint[i];
    const int type = described.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK;
    if (type != LIBUSB_TRANSFER_TYPE_BULK && type != LIBUSB_TRANSFER_TYPE_INTERRUPT) continue;
    const UsbEndpoint offered{described.bEndpointAddress, type == LIBUSB_TRANSFER_TYPE_INTERRUPT,
                              described.wMaxPacketSize & 0x7ff};
    if (offered.packet == 0) continue;
    if (wanted.stream != 0 && offered.address == wanted.stream) {
      found.stream = offered;
      continue;
    }
    const bool in = (offered.address & LIBUSB_ENDPOINT_IN) != 0;
    UsbEndpoint& has = in ? found.in : found.out;
    const std::uint8_t wish = in ? wanted.in : wanted.out;
    if (rank(offered, wish) < rank(has, wish)) has = offered;
  }
  return found;
}

}  // namespace

int claim_usb_interface(UsbBus& bus, libusb_device_handle* handle, int interface,
                        const std::function<bool()>& stopping) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  for (;;) {
    const int code = claim_once(handle, interface);
    if (code != LIBUSB_ERROR_NOT_FOUND || stopping() || std::chrono::steady_clock::now() > deadline) return code;
    bus.handle_events(kPause);
  }
}

Result<UsbEndpoints> find_usb_endpoints(const UsbDevicePtr& device, UsbAddresses wanted) {
  libusb_config_descriptor* config = nullptr;
  // One that was announced just now may not be configured yet; its only configuration can be read all the same.
  if (libusb_get_active_config_descriptor(device.get(), &config) != LIBUSB_SUCCESS &&
      libusb_get_config_descriptor(device.get(), 0, &config) != LIBUSB_SUCCESS) {
    return Error{"not_available", "the USB device does not describe itself", "", "unplug it and plug it in again"};
  }
  const std::unique_ptr<libusb_config_descriptor, decltype(&libusb_free_config_descriptor)> owner(
      config, libusb_free_config_descriptor);
  for (int i = 0; i < config->bNumInterfaces; ++i) {
    if (config->interface[i].num_altsetting <= 0) continue;
    const UsbEndpoints found = endpoints_of(config->interface[i].altsetting[0], wanted);
    if (found.out.address && found.in.address) return found;
  }
  return Error{"not_available", "the USB device has no pair of endpoints for data", "", "is it another product?"};
}

Error usb_open_error(int code, const UsbIdentity& who) {
  switch (code) {
    case LIBUSB_ERROR_ACCESS:
      return {"not_available", "no permission to open " + name_of(who), "",
              "install posed's udev rule (deploy/60-posed-trackers.rules) and plug the tracker in again"};
    case LIBUSB_ERROR_BUSY: {
      const std::string holder = usb_holder(who);
      return {"not_available", name_of(who) + " is in use by " + (holder.empty() ? "another program" : holder), "",
              "close the program that holds it (the vendor's, VRPN, another posed)"};
    }
    case LIBUSB_ERROR_NO_DEVICE:
      return {"not_available", name_of(who) + " went away while it was being opened", "", "is its cable loose?"};
    default:
      return {"not_available", name_of(who) + " cannot be opened: " + libusb_strerror(static_cast<libusb_error>(code)),
              "", "unplug it and plug it in again"};
  }
}

std::string usb_holder(const UsbIdentity& who) {
  return holder_of(node_of(who));
}

}  // namespace posed::tracker
