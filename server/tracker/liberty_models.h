// The LIBERTY models on USB: what differs between them, in one table.
// Sources: LIBERTY User Manual URM03PH156 Rev H; USB identities and endpoints as the vendor's firmware images and the
// public drivers (VRPN, the ROS driver, the vendor's Linux terminal) have them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "server/tracker/usb_pipe.h"

namespace posed::tracker {

inline constexpr std::uint16_t kPolhemusVendor = 0x0f44;

struct LibertyModel {
  std::string_view name;
  std::uint16_t product;
  std::uint16_t loader_product;   // how it enumerates until the host has put its firmware into the chip's memory
  std::string_view loader_type;   // fxload's -t
  std::string_view loader_image;  // fxload's -I
  UsbEndpoints endpoints;         // the pair that carries commands and data, among those that it has
  std::array<char, 2> tag;
  int stations;
  int rate_hz;
};

std::span<const LibertyModel> liberty_models();
const LibertyModel* liberty_by_product(std::uint16_t product);
const LibertyModel* liberty_by_loader(std::uint16_t product);

// What to tell of a tracker that waits for its firmware.
std::string firmware_advice(const LibertyModel& model, const UsbIdentity& who);

}  // namespace posed::tracker
