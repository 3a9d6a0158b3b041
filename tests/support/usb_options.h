// What an emulated tracker looks like on a USB bus, whoever plays the bus.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/tracker_emulator.h"

namespace posed::test {

struct UsbTestbedOptions {
  std::uint16_t vendor = 0x0f44, product = 0xff20;
  // LIBERTY HS as its firmware describes it: bulk 82 04 06 88. It talks on 04 and 88.
  std::string endpoints = "82 04 06 88";  // hexadecimal; with an i behind it: interrupt
  std::uint8_t out = 0x04, in = 0x88;
  std::uint8_t stream = 0;  // where cycles go; 0: where answers do
  int packet = 512;
  int port = 1;        // of the bus' root hub
  std::string serial;  // that it tells; empty: none, as of all that came before VIPER
  int stations = 2;    // of the LIBERTY, where no other device is given
  std::function<std::unique_ptr<TrackerEmulator>()> make_device;  // unset: a LIBERTY
};

// Its device descriptor (18 bytes), and behind it that of its one configuration with all interfaces and endpoints.
std::vector<std::uint8_t> descriptors_of(const UsbTestbedOptions& options);
std::unique_ptr<TrackerEmulator> device_of(const UsbTestbedOptions& options);

}  // namespace posed::test
