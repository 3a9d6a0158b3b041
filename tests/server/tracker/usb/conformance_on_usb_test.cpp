// The conformance suite over the real libusb and an emulated bus.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/server/tracker/conformance/conformance.h"
#include "tests/support/fastrak_emulator.h"
#include "tests/support/liberty_emulator.h"
#include "tests/support/usb_testbed.h"
#include "tests/support/viper_emulator.h"

namespace posed::tracker {
namespace {

ConformanceCase on_usb(std::string name, std::string kind, test::UsbTestbedOptions options) {
  ConformanceCase one;
  one.name = std::move(name);
  one.kind = std::move(kind);
  one.make = [options]() -> std::unique_ptr<test::TrackerTestbed> {
    std::string reason;
    auto bed = test::UsbTestbed::make(options, reason);
    if (!bed) std::fprintf(stderr, "%s\n", reason.c_str());
    return bed;
  };
  return one;
}

test::UsbTestbedOptions wired(std::uint16_t product, std::string endpoints, std::uint8_t out, std::uint8_t in,
                              int packet, std::function<std::unique_ptr<test::TrackerEmulator>()> device) {
  test::UsbTestbedOptions options;
  options.product = product;
  options.endpoints = std::move(endpoints);
  options.out = out;
  options.in = in;
  options.packet = packet;
  options.make_device = std::move(device);
  return options;
}

ConformanceCase fastrak() {
  auto options =
      wired(0x0002, "82 02 84i 04", 0x02, 0x82, 64, [] { return std::make_unique<test::FastrakEmulator>(); });
  options.stream = 0x84;
  return on_usb("fastrak", "fastrak", std::move(options));
}

ConformanceCase viper() {
  ConformanceCase one = on_usb(
      "viper", "viper", wired(0xbf01, "81 02", 0x02, 0x81, 64, [] { return std::make_unique<test::ViperEmulator>(); }));
  one.told_letter = 'I';
  return one;
}

INSTANTIATE_TEST_SUITE_P(
    Usb, Conformance,
    testing::Values(on_usb("liberty_hs", "liberty", {}),
                    on_usb("liberty", "liberty",
                           wired(0xff12, "82 02 06", 0x02, 0x82, 64,
                                 [] { return std::make_unique<test::LibertyEmulator>(); })),
                    on_usb("patriot_hs", "patriot",
                           wired(0xef20, "82 04 06 88", 0x04, 0x88, 512,
                                 [] { return std::make_unique<test::LibertyEmulator>(2, test::kPatriotKind); })),
                    on_usb("patriot", "patriot",
                           wired(0xef12, "82 02 06", 0x02, 0x82, 64,
                                 [] { return std::make_unique<test::LibertyEmulator>(2, test::kPatriotKind); })),
                    fastrak(), viper()),
    name_of);

}  // namespace
}  // namespace posed::tracker
