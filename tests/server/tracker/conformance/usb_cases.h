// The trackers on USB that must get over the conformance suite, as their own endpoints have them; whoever plays the
// bus.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/server/tracker/conformance/conformance.h"
#include "tests/support/fastrak_emulator.h"
#include "tests/support/liberty_emulator.h"
#include "tests/support/usb_options.h"
#include "tests/support/viper_emulator.h"

namespace posed::tracker {

// A bus makes what carries one: std::unique_ptr<TrackerTestbed>(UsbTestbedOptions).
template <class Bus>
std::vector<ConformanceCase> usb_cases(Bus bus) {
  std::vector<ConformanceCase> cases;
  const auto add = [&](std::string name, std::string kind, test::UsbTestbedOptions options) -> ConformanceCase& {
    ConformanceCase& one = cases.emplace_back();
    one.name = std::move(name);
    one.kind = std::move(kind);
    one.make = [bus, options] { return bus(options); };
    return one;
  };
  const auto wired = [](std::uint16_t product, std::string endpoints, std::uint8_t out, std::uint8_t in, int packet,
                        auto device) {
    test::UsbTestbedOptions options;
    options.product = product;
    options.endpoints = std::move(endpoints);
    options.out = out, options.in = in, options.packet = packet;
    options.make_device = device;
    return options;
  };
  const auto liberty = [] { return std::make_unique<test::LibertyEmulator>(); };
  const auto patriot = [] { return std::make_unique<test::LibertyEmulator>(2, test::kPatriotKind); };
  const auto fastrak = [] { return std::make_unique<test::FastrakEmulator>(); };
  const auto viper = [] { return std::make_unique<test::ViperEmulator>(); };

  add("liberty_hs", "liberty", {});
  add("liberty", "liberty", wired(0xff12, "82 02 06", 0x02, 0x82, 64, liberty));
  add("patriot_hs", "patriot", wired(0xef20, "82 04 06 88", 0x04, 0x88, 512, patriot));
  add("patriot", "patriot", wired(0xef12, "82 02 06", 0x02, 0x82, 64, patriot));
  test::UsbTestbedOptions two_ways = wired(0x0002, "82 02 84i 04", 0x02, 0x82, 64, fastrak);
  two_ways.stream = 0x84;
  add("fastrak", "fastrak", two_ways);
  add("viper", "viper", wired(0xbf01, "81 02", 0x02, 0x81, 64, viper)).told_letter = 'I';
  return cases;
}

}  // namespace posed::tracker
