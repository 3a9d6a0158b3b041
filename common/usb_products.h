// Who trackers are on USB: shared by the daemon, which opens them, and by posectl doctor, which says why it can not.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace posed {

inline constexpr std::uint16_t kPolhemusVendor = 0x0f44;

struct UsbProduct {
  std::string_view name;
  std::uint16_t product;
  std::uint16_t loader;  // how it enumerates until the host has given it its firmware; 0: it has it
  bool served;           // by a kind of tracker
};

inline constexpr std::array kPolhemusProducts{
    UsbProduct{"LIBERTY HS", 0xff20, 0xff21, true}, UsbProduct{"LIBERTY", 0xff12, 0xff11, true},
    UsbProduct{"PATRIOT HS", 0xef20, 0xef21, true}, UsbProduct{"PATRIOT", 0xef12, 0xef11, true},
    UsbProduct{"FASTRAK", 0x0002, 0x0001, true},    UsbProduct{"VIPER", 0xbf01, 0, true},
    UsbProduct{"FASTRAK 3", 0x0003, 0, false},      UsbProduct{"G4", 0xcf01, 0, false},
};

}  // namespace posed
