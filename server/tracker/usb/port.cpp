#include "server/tracker/usb/port.h"

#include <algorithm>
#include <cctype>
#include <thread>
#include <utility>
#include <vector>

#include "server/tracker/usb/models.h"
#include "server/tracker/usb/pipe.h"

namespace posed::tracker {
namespace {

std::string capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// "the LIBERTY HS A17 (port 1-2)"
std::string describe(const UsbModel& model, const DevicePlace& place) {
  const std::string name = "the " + std::string(model.name) + " ";
  return place.serial.empty() ? name + "at port " + place.port : name + place.serial + " (port " + place.port + ")";
}

}  // namespace

Opened UsbPort::open(const std::function<bool()>& stopping) {
  if (!bus_) {
    auto bus = UsbBus::open(kPolhemusVendor);
    if (!bus) return {nullptr, State::failed, bus.error().message + ": " + bus.error().hint};
    const std::lock_guard lock(mutex_);
    bus_ = std::move(*bus);
  }
  bus_->take_change();
  Opened opened;
  Owners& owners = Owners::of_process();
  std::string others, taken;
  std::vector<UsbDevicePtr> devices = bus_->devices();
  std::stable_partition(devices.begin(), devices.end(),
                        [&](const UsbDevicePtr& device) { return owners.own(this, UsbBus::place(device)); });
  for (const UsbDevicePtr& device : devices) {
    const UsbIdentity who = UsbBus::identity(device);
    if (const UsbModel* waits = usb_model_by_loader(who.product); waits && waits->family == family_) {
      if (opened.message.empty()) opened.message = firmware_advice(*waits, who);
      continue;
    }
    const UsbModel* model = usb_model_by_product(who.product);
    if (model && model->family != family_) {
      others +=
          "; a " + std::string(model->name) + " is there" +
          (model->family.empty() ? ", which posed does not serve yet" : ": --tracker " + std::string(model->family));
    }
    if (!model || model->family != family_) continue;
    const DevicePlace place = UsbBus::place(device);
    if (!place.is(wanted_)) {
      others += "; " + describe(*model, place) + " is there: --tracker " + family_ + ":usb:" + place.name();
      continue;
    }
    if (wanted_.empty() && owners.anothers(this, place)) {
      taken += "; " + describe(*model, place) + " is another tracker's of this station";
      continue;
    }
    auto pipe = UsbPipe::open(*bus_, device, model->endpoints, now_, stopping);
    if (pipe) {
      if (wanted_.empty()) owners.take(this, place.name());
      opened.line = std::move(*pipe);
      return opened;
    }
    opened.state = State::failed;
    opened.message = pipe.error().message + ": " + pipe.error().hint;
  }
  if (opened.message.empty()) {
    opened.message = "no " + std::string(taken.empty() ? "" : "further ") + capitals(family_) +
                     (wanted_.empty() ? "" : " with serial number or at port " + wanted_) +
                     " is on USB: is it switched on and plugged in?" + taken + others;
  }
  return opened;
}

bool UsbPort::rest(std::chrono::milliseconds at_most) {
  if (!bus_) {
    std::this_thread::sleep_for(at_most);
    return false;
  }
  if (bus_->take_change()) return true;
  bus_->handle_events(at_most);
  return bus_->take_change();
}

void UsbPort::interrupt() {
  const std::lock_guard lock(mutex_);
  if (bus_) bus_->interrupt();
}

}  // namespace posed::tracker
