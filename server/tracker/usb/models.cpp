#include "server/tracker/usb/models.h"

#include <cstdio>
#include <iterator>

namespace posed::tracker {
namespace {

// A FASTRAK answers on 82 and streams on 84.
constexpr UsbModel kModels[] = {
    {"liberty", "LIBERTY HS", 0xff20, 0xff21, "fx2", "LbtyUsbHS.hex", {0x04, 0x88, 0}},
    {"liberty", "LIBERTY", 0xff12, 0xff11, "fx", "LbtyUsb.hex", {0x02, 0x82, 0}},
    {"patriot", "PATRIOT HS", 0xef20, 0xef21, "fx2", "PatriotUSB2.hex", {0x04, 0x88, 0}},
    {"patriot", "PATRIOT", 0xef12, 0xef11, "fx", "PatriotUSB.hex", {0x02, 0x82, 0}},
    {"fastrak", "FASTRAK", 0x0002, 0x0001, "fx", "FastrakUSB.hex", {0x02, 0x82, 0x84}},
    {"viper", "VIPER", 0xbf01, 0, "", "", {}},
    {"", "FASTRAK 3", 0x0003, 0, "", "", {}},
    {"", "G4", 0xcf01, 0, "", "", {}},
};

static_assert(std::size(kModels) == kPolhemusProducts.size());
static_assert(
    [] {
      for (std::size_t i = 0; i < std::size(kModels); ++i) {
        const UsbProduct& known = kPolhemusProducts[i];
        if (kModels[i].name != known.name || kModels[i].product != known.product ||
            kModels[i].loader_product != known.loader || kModels[i].family.empty() == known.served)
          return false;
      }
      return true;
    }(),
    "posectl doctor and the daemon know the same trackers");

}  // namespace

std::span<const UsbModel> usb_models() {
  return kModels;
}

const UsbModel* usb_model_by_product(std::uint16_t product) {
  for (const UsbModel& model : kModels) {
    if (model.product == product) return &model;
  }
  return nullptr;
}

const UsbModel* usb_model_by_loader(std::uint16_t product) {
  for (const UsbModel& model : kModels) {
    if (model.loader_product != 0 && model.loader_product == product) return &model;
  }
  return nullptr;
}

std::string firmware_advice(const UsbModel& model, const UsbIdentity& who) {
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
