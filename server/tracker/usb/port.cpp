#include "server/tracker/usb/port.h"

#include <cctype>
#include <thread>
#include <utility>

#include "server/tracker/usb/models.h"
#include "server/tracker/usb/pipe.h"

namespace posed::tracker {
namespace {

std::string capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
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
  std::string others;
  for (const UsbDevicePtr& device : bus_->devices()) {
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
    auto pipe = UsbPipe::open(*bus_, device, model->endpoints, now_, stopping);
    if (pipe) {
      opened.line = std::move(*pipe);
      return opened;
    }
    opened.state = State::failed;
    opened.message = pipe.error().message + ": " + pipe.error().hint;
  }
  if (opened.message.empty()) {
    opened.message = "no " + capitals(family_) + " is on USB: is it switched on and plugged in?" + others;
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
