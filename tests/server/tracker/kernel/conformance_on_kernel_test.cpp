// The conformance suite over the real libusb and a real kernel's USB stack.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/server/tracker/conformance/usb_cases.h"
#include "tests/support/usb_kernel_testbed.h"

namespace posed::tracker {
namespace {

std::unique_ptr<test::TrackerTestbed> on_kernel(const test::UsbTestbedOptions& options) {
  std::string reason;
  auto bed = test::UsbKernelTestbed::make(options, reason);
  if (!bed) std::fprintf(stderr, "%s\n", reason.c_str());
  return bed;
}

INSTANTIATE_TEST_SUITE_P(Kernel, Conformance, testing::ValuesIn(usb_cases(on_kernel)), name_of);

}  // namespace
}  // namespace posed::tracker
