#include "server/tracker/usb_claim.h"

#include <libusb.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>
#include <vector>

namespace posed::tracker {
namespace {

namespace fs = std::filesystem;

constexpr auto kPatience = std::chrono::seconds(1);
constexpr auto kPause = std::chrono::milliseconds(5);

int claim_once(libusb_device_handle* handle) {
  int configuration = 0;
  if (const int code = libusb_get_configuration(handle, &configuration); code != LIBUSB_SUCCESS) return code;
  if (configuration == 0) {
    // Setting one that is set already would reset the device, so this is done only where there is none.
    if (const int code = libusb_set_configuration(handle, 1); code != LIBUSB_SUCCESS) return code;
  }
  const int code = libusb_claim_interface(handle, 0);
  // A generic kernel driver (usbserial, told to) may sit on it; another program must not be pushed off.
  if (code != LIBUSB_ERROR_BUSY || libusb_kernel_driver_active(handle, 0) != 1) return code;
  libusb_detach_kernel_driver(handle, 0);
  return libusb_claim_interface(handle, 0);
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

// Processes come and go while one looks, and most may not be looked into: both end the list, neither throws.
std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    found.push_back(at->path());
  }
  return found;
}

}  // namespace

int claim_usb_interface(UsbBus& bus, libusb_device_handle* handle, const std::function<bool()>& stopping) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  for (;;) {
    const int code = claim_once(handle);
    if (code != LIBUSB_ERROR_NOT_FOUND || stopping() || std::chrono::steady_clock::now() > deadline) return code;
    bus.handle_events(kPause);
  }
}

Result<UsbEndpoints> find_usb_endpoints(const UsbDevicePtr& device, UsbEndpoints wanted) {
  libusb_config_descriptor* config = nullptr;
  if (libusb_get_active_config_descriptor(device.get(), &config) != LIBUSB_SUCCESS) {
    return Error{"not_available", "the USB device does not describe itself", "", "unplug it and plug it in again"};
  }
  const std::unique_ptr<libusb_config_descriptor, decltype(&libusb_free_config_descriptor)> owner(
      config, libusb_free_config_descriptor);
  UsbEndpoints found;
  const auto better = [](std::uint8_t has, std::uint8_t offered, std::uint8_t wish) {
    return has == 0 || (has != wish && offered == wish);
  };
  if (config->bNumInterfaces > 0 && config->interface[0].num_altsetting > 0) {
    const libusb_interface_descriptor& face = config->interface[0].altsetting[0];
    for (int i = 0; i < face.bNumEndpoints; ++i) {
      const libusb_endpoint_descriptor& endpoint = face.endpoint[i];
      if ((endpoint.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) != LIBUSB_TRANSFER_TYPE_BULK) continue;
      const std::uint8_t address = endpoint.bEndpointAddress;
      if (!(address & LIBUSB_ENDPOINT_IN)) {
        if (better(found.out, address, wanted.out)) found.out = address;
      } else if (better(found.in, address, wanted.in)) {
        found.in = address;
        found.in_packet = endpoint.wMaxPacketSize & 0x7ff;
      }
    }
  }
  if (found.out && found.in && found.in_packet > 0) return found;
  return Error{"not_available", "the USB device has no pair of bulk endpoints", "", "is it another product?"};
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
  const std::string node = node_of(who);
  for (const fs::path& process : entries("/proc")) {
    const std::string pid = process.filename();
    if (pid.find_first_not_of("0123456789") != std::string::npos || pid == std::to_string(::getpid())) continue;
    for (const fs::path& descriptor : entries(process / "fd")) {
      std::error_code ignored;
      if (fs::read_symlink(descriptor, ignored) != node) continue;
      std::ifstream comm(process / "comm");
      std::string name;
      std::getline(comm, name);
      return name.append(" (process ").append(pid).append(")");
    }
  }
  return {};
}

}  // namespace posed::tracker
