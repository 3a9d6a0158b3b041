// Two trackers of a kind on one bus: each keeps its device, and one can be asked for by name.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "server/tracker/registry.h"
#include "tests/support/usb_testbed.h"
#include "tests/support/watched_tracker.h"

namespace posed::tracker {
namespace {

using test::LibertyEmulator;
using test::UsbTestbed;
using test::UsbTestbedOptions;
using test::WatchedTracker;

// A LIBERTY that is told by where its first sensor is: so many inches in front of its source.
std::unique_ptr<UsbTestbed> liberty(int port, double inches, std::string serial = "") {
  UsbTestbedOptions options;
  options.port = port;
  options.serial = std::move(serial);
  std::string reason;
  auto bed = UsbTestbed::make(std::move(options), reason);
  EXPECT_TRUE(bed) << reason;
  if (bed) bed->with_device([&](LibertyEmulator& device) { device.set_pose(1, {inches, 0, 0, 0, 0, 0}); });
  return bed;
}

bool hears(WatchedTracker& run, double inches) {
  return run.wait_for_frame([&](const Frame& f) { return std::abs(f.samples[0].position.x - 0.0254 * inches) < 1e-5; });
}

TEST(TwoOfAKind, AreToldApartByPortAndBySerialNumber) {
  const auto first = liberty(1, 10), second = liberty(2, 20, "A17");
  ASSERT_TRUE(first && second);
  first->plug();
  second->plug();
  WatchedTracker by_serial("liberty:usb:A17"), by_port("liberty:usb:1-1");
  EXPECT_TRUE(hears(by_serial, 20)) << by_serial.status().message;
  EXPECT_TRUE(hears(by_port, 10)) << by_port.status().message;
}

TEST(TwoOfAKind, OneThatIsNotThereIsToldWithThoseThatAre) {
  const auto first = liberty(1, 10), second = liberty(2, 20, "A17");
  ASSERT_TRUE(first && second);
  first->plug();
  second->plug();
  WatchedTracker run("liberty:usb:B99");
  ASSERT_TRUE(run.wait_for_message("no LIBERTY with serial number or at port B99 is on USB"));
  EXPECT_NE(run.status().message.find("the LIBERTY HS at port 1-1 is there: --tracker liberty:usb:1-1"),
            std::string::npos)
      << run.status().message;
  EXPECT_NE(run.status().message.find("the LIBERTY HS A17 (port 1-2) is there: --tracker liberty:usb:A17"),
            std::string::npos)
      << run.status().message;
  EXPECT_EQ(first->claims() + second->claims(), 0);
}

// Whichever comes back first.
TEST(TwoOfAKind, EachKeepsItsOwnOverReplugs) {
  const auto first = liberty(1, 10), second = liberty(2, 20, "A17");
  ASSERT_TRUE(first && second);
  first->plug();
  WatchedTracker one("liberty");
  ASSERT_TRUE(hears(one, 10)) << one.status().message;
  second->plug();
  WatchedTracker two("liberty");
  ASSERT_TRUE(hears(two, 20)) << two.status().message;
  for (const bool first_comes_first : {true, false}) {
    first->unplug();
    second->unplug();
    ASSERT_TRUE(one.wait_for_state(State::searching));
    ASSERT_TRUE(two.wait_for_state(State::searching));
    UsbTestbed& sooner = first_comes_first ? *first : *second;
    UsbTestbed& later = first_comes_first ? *second : *first;
    sooner.plug();
    ASSERT_TRUE((first_comes_first ? one : two).wait_for_frames(20));
    ASSERT_TRUE((first_comes_first ? two : one).wait_for_message("is another tracker's of this station"));
    later.plug();
    ASSERT_TRUE(one.wait_for_frames(20)) << one.status().message;
    ASSERT_TRUE(two.wait_for_frames(20)) << two.status().message;
  }
  one.stop();
  two.stop();
  for (const Frame& frame : one.frames()) EXPECT_NEAR(frame.samples[0].position.x, 0.254, 1e-5);
  for (const Frame& frame : two.frames()) EXPECT_NEAR(frame.samples[0].position.x, 0.508, 1e-5);
}

TEST(TwoOfAKind, OneThatIsAskedForByNameIsNotTakenByAnother) {
  const auto first = liberty(1, 10), second = liberty(2, 20, "A17");
  ASSERT_TRUE(first && second);
  WatchedTracker any("liberty"), named("liberty:usb:1-1");
  first->plug();
  ASSERT_TRUE(hears(named, 10)) << named.status().message;
  second->plug();
  ASSERT_TRUE(hears(any, 20)) << any.status().message;
  any.stop();
  for (const Frame& frame : any.frames()) EXPECT_NEAR(frame.samples[0].position.x, 0.508, 1e-5);
}

// A serial number goes along with the device; the other one is known by its port alone.
TEST(TwoOfAKind, AtAnotherPortItIsKnownByItsSerialNumber) {
  const auto bed = liberty(1, 10, "A17"), moved = liberty(3, 30, "A17");  // they outlive the driver
  ASSERT_TRUE(bed && moved);
  bed->plug();
  WatchedTracker run("liberty:usb:A17");
  ASSERT_TRUE(hears(run, 10)) << run.status().message;
  bed->unplug();
  ASSERT_TRUE(run.wait_for_state(State::searching));
  moved->plug();
  EXPECT_TRUE(hears(run, 30)) << run.status().message;
}

}  // namespace
}  // namespace posed::tracker
