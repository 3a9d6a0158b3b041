#include "server/tracker/liberty_models.h"

#include <cstdio>

namespace posed::tracker {
namespace {

constexpr LibertyModel kModels[] = {
    {"LIBERTY HS", 0xff20, 0xff21, "fx2", "LbtyUsbHS.hex", {0x04, 0x88, 512}, {'L', 'Y'}, 16, 240},
    {"LIBERTY", 0xff12, 0xff11, "fx", "LbtyUsb.hex", {0x02, 0x82, 64}, {'L', 'Y'}, 16, 240},
};

}  // namespace

std::span<const LibertyModel> liberty_models() {
  return kModels;
}

const LibertyModel* liberty_by_product(std::uint16_t product) {
  for (const LibertyModel& model : kModels) {
    if (model.product == product) return &model;
  }
  return nullptr;
}

const LibertyModel* liberty_by_loader(std::uint16_t product) {
  for (const LibertyModel& model : kModels) {
    if (model.loader_product == product) return &model;
  }
  return nullptr;
}

std::string firmware_advice(const LibertyModel& model, const UsbIdentity& who) {
  char text[500];
  std::snprintf(
      text, sizeof text,
      "a %.*s without its firmware is on USB (%04x:%04x); the firmware is Polhemus' and not part of posed: with its "
      "files "
      "at hand uncomment this tracker's line in deploy/60-posed-trackers.rules, install that, and plug the tracker in "
      "again; by hand: fxload -t %.*s -s a3load.hex -I %.*s -D "
      "/dev/bus/usb/%03d/%03d",
      static_cast<int>(model.name.size()), model.name.data(), who.vendor, who.product,
      static_cast<int>(model.loader_type.size()), model.loader_type.data(), static_cast<int>(model.loader_image.size()),
      model.loader_image.data(), who.bus, who.address);
  return text;
}

}  // namespace posed::tracker
