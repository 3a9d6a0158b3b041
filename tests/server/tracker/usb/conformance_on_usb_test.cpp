// The conformance suite over the real libusb and an emulated bus.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/server/tracker/conformance/usb_cases.h"
#include "tests/support/usb_testbed.h"

namespace posed::tracker {
namespace {

std::unique_ptr<test::TrackerTestbed> on_umockdev(const test::UsbTestbedOptions& options) {
  std::string reason;
  auto bed = test::UsbTestbed::make(options, reason);
  if (!bed) std::fprintf(stderr, "%s\n", reason.c_str());
  return bed;
}

INSTANTIATE_TEST_SUITE_P(Usb, Conformance, testing::ValuesIn(usb_cases(on_umockdev)), name_of);

}  // namespace
}  // namespace posed::tracker
