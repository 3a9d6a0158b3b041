// The trackers on USB: what differs between them, in one table.
// Sources: USB identities and endpoints as the vendor's firmware images and the public drivers (VRPN, the ROS driver,
// the vendor's Linux terminal) have them; VIPER's from its SDK.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/usb_products.h"
#include "server/tracker/usb/pipe.h"

namespace posed::tracker {

struct UsbModel {
  std::string_view family;  // the kind that serves it; empty: none does yet
  std::string_view name;
  std::uint16_t product;
  std::uint16_t loader_product;   // how it enumerates until the host has put its firmware into its memory; 0: it has it
  std::string_view loader_type;   // fxload's -t
  std::string_view loader_image;  // fxload's -I
  UsbAddresses endpoints;         // those that carry commands and data, among those that it has; all 0: its first pair
};

std::span<const UsbModel> usb_models();
const UsbModel* usb_model_by_product(std::uint16_t product);
const UsbModel* usb_model_by_loader(std::uint16_t product);

// What to tell of a tracker that waits for its firmware.
std::string firmware_advice(const UsbModel& model, const UsbIdentity& who);

}  // namespace posed::tracker
