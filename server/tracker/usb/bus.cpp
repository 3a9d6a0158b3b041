#include "server/tracker/usb/bus.h"

#include <libusb.h>

#include <sys/types.h>

#include <fstream>
#include <string>
#include <utility>

namespace posed::tracker {

Result<std::unique_ptr<UsbBus>> UsbBus::open(std::uint16_t vendor) {
  libusb_context* context = nullptr;
  if (const int code = libusb_init(&context); code != LIBUSB_SUCCESS) {
    return Error{"not_available",
                 std::string("USB cannot be used: ") + libusb_strerror(static_cast<libusb_error>(code)), "",
                 "is /dev/bus/usb there?"};
  }
  return std::unique_ptr<UsbBus>(new UsbBus(context, vendor));
}

UsbBus::UsbBus(libusb_context* context, std::uint16_t vendor) : context_(context), vendor_(vendor) {
  if (!libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG)) return;
  const auto callback = [](libusb_context* ctx, libusb_device* device, libusb_hotplug_event event, void* bus) {
    return on_hotplug(ctx, device, event, bus);
  };
  const int events = LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT;
  const int code = libusb_hotplug_register_callback(context_, events, 0, vendor_, LIBUSB_HOTPLUG_MATCH_ANY,
                                                    LIBUSB_HOTPLUG_MATCH_ANY, callback, this, &hotplug_handle_);
  if (code != LIBUSB_SUCCESS) hotplug_handle_ = -1;
}

UsbBus::~UsbBus() {
  if (hotplug_handle_ != -1) libusb_hotplug_deregister_callback(context_, hotplug_handle_);
  libusb_exit(context_);
}

// An announcement may come twice for one device, and before the kernel has configured it. So it only says "look again":
// the list holds each device once, and opening has patience.
int UsbBus::on_hotplug(libusb_context*, libusb_device*, int, void* bus) {
  static_cast<UsbBus*>(bus)->changed_ = true;
  return 0;
}

std::vector<UsbDevicePtr> UsbBus::devices() const {
  std::vector<UsbDevicePtr> found;
  libusb_device** list = nullptr;
  const ssize_t count = libusb_get_device_list(context_, &list);
  for (ssize_t i = 0; i < count; ++i) {
    libusb_device_descriptor descriptor{};
    if (libusb_get_device_descriptor(list[i], &descriptor) == LIBUSB_SUCCESS && descriptor.idVendor == vendor_) {
      found.emplace_back(libusb_ref_device(list[i]), libusb_unref_device);
    }
  }
  if (count >= 0) libusb_free_device_list(list, 1);
  return found;
}

void UsbBus::handle_events(std::chrono::milliseconds at_most) {
  timeval timeout{};
  timeout.tv_sec = at_most.count() / 1000;
  timeout.tv_usec = at_most.count() % 1000 * 1000;
  libusb_handle_events_timeout_completed(context_, &timeout, nullptr);
}

void UsbBus::interrupt() {
  libusb_interrupt_event_handler(context_);
}

bool UsbBus::take_change() {
  return std::exchange(changed_, false);
}

// The kernel's copy of the serial number: asking the device would mean to open it, whoever has it.
DevicePlace UsbBus::place(const UsbDevicePtr& device) {
  constexpr int kDeepest = 7;
  std::uint8_t ports[kDeepest] = {};
  DevicePlace place;
  place.port = std::to_string(libusb_get_bus_number(device.get()));
  const int depth = libusb_get_port_numbers(device.get(), ports, kDeepest);
  for (int i = 0; i < depth; ++i) place.port += (i == 0 ? "-" : ".") + std::to_string(ports[i]);
  std::ifstream file("/sys/bus/usb/devices/" + place.port + "/serial");
  std::getline(file, place.serial);
  return place;
}

UsbIdentity UsbBus::identity(const UsbDevicePtr& device) {
  libusb_device_descriptor descriptor{};
  libusb_get_device_descriptor(device.get(), &descriptor);
  return {descriptor.idVendor, descriptor.idProduct, libusb_get_bus_number(device.get()),
          libusb_get_device_address(device.get())};
}

}  // namespace posed::tracker
