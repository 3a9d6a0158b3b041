// The conformance suite over ptys.
#include <gtest/gtest.h>

#include "tests/server/tracker/conformance/conformance.h"
#include "tests/support/fastrak_emulator.h"
#include "tests/support/liberty_emulator.h"
#include "tests/support/pty_testbed.h"

namespace posed::tracker {
namespace {

ConformanceCase on_serial(std::string name, std::string kind,
                          std::function<std::unique_ptr<test::TrackerEmulator>()> emulator, double tolerance = 1e-5) {
  ConformanceCase one;
  one.name = std::move(name);
  one.kind = std::move(kind);
  one.make = [emulator] { return std::make_unique<test::PtyTestbed>(emulator()); };
  one.tolerance = tolerance;
  return one;
}

std::unique_ptr<test::TrackerEmulator> liberty(const test::LibertyKind& kind) {
  auto device = std::make_unique<test::LibertyEmulator>(2, kind);
  device->set_on_serial(true);
  return device;
}

INSTANTIATE_TEST_SUITE_P(
    Serial, Conformance,
    testing::Values(on_serial("liberty", "liberty", [] { return liberty({}); }),
                    on_serial("patriot", "patriot", [] { return liberty(test::kPatriotKind); }),
                    on_serial("fastrak", "fastrak", [] { return std::make_unique<test::FastrakEmulator>(); }),
                    // Its steps are 0.05 mm and 1/32767.
                    on_serial(
                        "isotrak", "isotrak",
                        [] { return std::make_unique<test::FastrakEmulator>(2, test::FastrakEmulator::Kind::isotrak); },
                        4e-5)),
    name_of);

}  // namespace
}  // namespace posed::tracker
