// The driver and the real libusb, against an emulated LIBERTY. Waits are for events, with generous limits.
#include <gtest/gtest.h>

#include <cerrno>
#include <string>
#include <utility>
#include <vector>

#include "server/tracker/driver.h"
#include "server/tracker/liberty/session.h"
#include "server/tracker/usb/port.h"
#include "tests/support/usb_testbed.h"
#include "tests/support/watched_tracker.h"

namespace posed::tracker {
namespace {

using test::LibertyEmulator;
using test::UsbTestbed;
using test::UsbTestbedOptions;

class Watched : public test::WatchedTracker {
 public:
  explicit Watched(LibertyOptions options = {})
      : WatchedTracker([&](TimeSource now) {
          return std::make_unique<Driver>(DriverParts{options.id, "liberty", 240,
                                                      std::make_unique<UsbPort>("liberty", "", std::move(now)), nullptr,
                                                      [options] { return std::make_unique<LibertySession>(options); }});
        }) {}
};

class LibertyOnUsb : public testing::Test {
 protected:
  void set_up(UsbTestbedOptions options = {}) {
    std::string reason;
    bed = UsbTestbed::make(std::move(options), reason);
    if (!bed) FAIL() << reason;  // where umockdev is missing this program is not even built
  }
  bool device_streams() { return bed->ask(&LibertyEmulator::streaming); }

  std::unique_ptr<UsbTestbed> bed;
};

#define SET_UP(...)    \
  set_up(__VA_ARGS__); \
  if (!bed) return

TEST_F(LibertyOnUsb, StartsStreamsAndLeavesItQuiet) {
  SET_UP();
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_frames(100)) << run.status().message;
  EXPECT_EQ(run.status().state, State::streaming);
  EXPECT_TRUE(bed->claimed());
  EXPECT_TRUE(bed->ask(&LibertyEmulator::binary));
  EXPECT_FALSE(bed->ask(&LibertyEmulator::buffering));
  run.stop();
  EXPECT_FALSE(device_streams());
  EXPECT_FALSE(bed->claimed());

  const std::vector<Frame> frames = run.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].device, "liberty");
    ASSERT_EQ(frames[i].samples.size(), 2u) << i;
    const Sample& sample = frames[i].samples[0];
    EXPECT_EQ(frames[i].samples[1].station, 2);
    EXPECT_NEAR(sample.position.x, 0.254, 1e-6);
    EXPECT_NEAR(sample.position.y, 0.0635, 1e-6);
    EXPECT_NEAR(sample.position.z, -0.08255, 1e-6);
    EXPECT_NEAR(sample.rotation.w, 0.871836437, 1e-6);
    EXPECT_NEAR(sample.rotation.z, -0.397692569, 1e-6);
    if (i == 0) continue;
    EXPECT_GT(sample.device_count, frames[i - 1].samples[0].device_count);
    EXPECT_GE(frames[i].t_ns, frames[i - 1].t_ns);
  }
}

TEST_F(LibertyOnUsb, PluggedInLater) {
  SET_UP();
  Watched run;
  ASSERT_TRUE(run.wait_for_state(State::searching));
  bed->plug();
  ASSERT_TRUE(run.wait_for_frames(10));
}

TEST_F(LibertyOnUsb, AStreamThatACrashLeftBehindIsStopped) {
  SET_UP();
  // ASCII, another list, and half a command typed.
  bed->with_device([](LibertyEmulator& device) { device.write("O*,2,4,1\rC\rO*,8"); });
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_frames(20)) << run.status().message;
  run.stop();
  EXPECT_NEAR(run.frames()[0].samples[0].position.x, 0.254, 1e-6);
}

TEST_F(LibertyOnUsb, ABinaryStreamThatACrashLeftBehindIsStopped) {
  SET_UP();
  bed->with_device([](LibertyEmulator& device) { device.write("F1\rU0\rO*,8,9,11,3,7\rC\r"); });
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_frames(20)) << run.status().message;
  run.stop();
  // Not one of the stale ones in inches.
  for (const Frame& frame : run.frames()) EXPECT_NEAR(frame.samples[0].position.x, 0.254, 1e-6);
}

TEST_F(LibertyOnUsb, UnpluggedInFlightAndPluggedInAgain) {
  SET_UP();
  bed->plug();
  Watched run;
  for (const bool as_error : {false, true, false}) {
    ASSERT_TRUE(run.wait_for_frames(20)) << run.status().message;
    bed->unplug(as_error);
    ASSERT_TRUE(run.wait_for_state(State::searching));
    EXPECT_FALSE(bed->claimed());
    bed->plug();
  }
  ASSERT_TRUE(run.wait_for_frames(20)) << run.status().message;
  run.stop();
  EXPECT_FALSE(device_streams());
}

TEST_F(LibertyOnUsb, StopsWhileUnplugged) {
  SET_UP();
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_frames(5));
  bed->unplug();
  run.stop();
}

TEST_F(LibertyOnUsb, BusyIsToldAndTriedAgain) {
  SET_UP();
  bed->fail_claims(EBUSY);
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_state(State::failed));
  EXPECT_NE(run.status().message.find("in use by another program"), std::string::npos) << run.status().message;
  bed->fail_claims(0);
  ASSERT_TRUE(run.wait_for_frames(5));
  EXPECT_EQ(run.status().message, "");
}

TEST_F(LibertyOnUsb, AnnouncedTooEarlyIsWaitedFor) {
  SET_UP();
  bed->fail_claims(ENOENT, 20);  // libusb: NOT_FOUND, the device is not configured yet
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  EXPECT_EQ(bed->claims(), 1);
}

TEST_F(LibertyOnUsb, WithoutFirmwareTheCureIsTold) {
  UsbTestbedOptions options;
  options.product = 0xff21;
  SET_UP(options);
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_message("fxload"));
  EXPECT_EQ(run.status().state, State::searching);
  EXPECT_NE(run.status().message.find("LbtyUsbHS.hex -D /dev/bus/usb/001/001"), std::string::npos);
  EXPECT_EQ(bed->claims(), 0);
}

TEST_F(LibertyOnUsb, AnotherFamilyOnTheBusIsToldOf) {
  UsbTestbedOptions options;
  options.product = 0xef12;
  SET_UP(options);
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_message("no LIBERTY is on USB"));
  EXPECT_NE(run.status().message.find("a PATRIOT is there: --tracker patriot"), std::string::npos);
  EXPECT_EQ(bed->claims(), 0);
}

TEST_F(LibertyOnUsb, ATrackerThatNobodyServesIsToldOf) {
  UsbTestbedOptions options;
  options.product = 0x0003;
  SET_UP(options);
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_message("a FASTRAK 3 is there, which posed does not serve yet"));
  EXPECT_EQ(bed->claims(), 0);
}

TEST_F(LibertyOnUsb, TheLegacyModelHasOtherEndpointsAndPackets) {
  UsbTestbedOptions options;
  options.product = 0xff12;
  options.endpoints = "82 02 06";
  options.out = 0x02;
  options.in = 0x82;
  options.packet = 64;
  options.stations = 4;  // 4 x 48 bytes are three full packets, which no short one ends
  SET_UP(options);
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_frames(20)) << run.status().message;
  EXPECT_EQ(run.frames().back().samples.size(), 4u);
}

TEST_F(LibertyOnUsb, SixteenStationsNeedTwoPackets) {
  UsbTestbedOptions options;
  options.stations = 16;
  SET_UP(options);
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_frames(50));
  run.stop();
  for (const Frame& frame : run.frames()) EXPECT_EQ(frame.samples.size(), 16u);
  EXPECT_EQ(run.status().bad_bytes, 0u);
}

TEST_F(LibertyOnUsb, SensorsComeAndGo) {
  SET_UP();
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_stations(2));
  bed->with_device([](LibertyEmulator& device) { device.unplug_sensor(2); });
  ASSERT_TRUE(run.wait_for_stations(1));
  bed->with_device([](LibertyEmulator& device) { device.plug_sensor(3); });
  ASSERT_TRUE(run.wait_for_stations(2));
  EXPECT_EQ(run.frames().back().samples[1].station, 3);
}

TEST_F(LibertyOnUsb, AStallAndAnOverflowAreGotOver) {
  SET_UP();
  bed->plug();
  Watched run;
  for (const int error : {EPIPE, EOVERFLOW, EPIPE}) {
    ASSERT_TRUE(run.wait_for_frames(20));
    bed->fail_next_read(error);
  }
  ASSERT_TRUE(run.wait_for_frames(20));
  EXPECT_EQ(bed->claims(), 1);
}

TEST_F(LibertyOnUsb, AnErrorOfTheDeviceIsTold) {
  SET_UP();
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_frames(20));
  bed->with_device([](LibertyEmulator& device) { device.write("\r"); });
  ASSERT_TRUE(run.wait_for_message("invalid command (error 1)"));
  ASSERT_TRUE(run.wait_for_frames(20));
  EXPECT_EQ(run.status().bad_bytes, 0u);
}

TEST_F(LibertyOnUsb, GarbageInTheStreamIsCounted) {
  SET_UP();
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_frames(20));
  bed->inject("garbage");
  ASSERT_TRUE(run.wait_for_frames(300));  // more than a second: the status comes round
  run.stop();
  EXPECT_EQ(run.status().bad_bytes, 7u);
}

TEST_F(LibertyOnUsb, TheStylusButtonAndTheDistortionAreHeard) {
  SET_UP();
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_frames(20));
  bed->with_device([](LibertyEmulator& device) {
    device.press_button(2, true);
    device.set_distortion(1, 1);
  });
  ASSERT_TRUE(run.wait_for_frame([](const Frame& frame) {
    return frame.samples.size() == 2 && frame.samples[1].buttons == 1 && frame.samples[0].buttons == 0 &&
           (frame.samples[0].flags & kFlagDistorted) != 0;
  }));
  bed->with_device([](LibertyEmulator& device) { device.press_button(2, false); });
  ASSERT_TRUE(run.wait_for_frame([](const Frame& frame) { return frame.samples[1].buttons == 0; }));
}

TEST_F(LibertyOnUsb, AStreamThatDiesIsStartedAnew) {
  SET_UP();
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_frames(20));
  bed->with_device([](LibertyEmulator& device) { device.write("P"); });  // as a stylus button may do
  ASSERT_TRUE(run.wait_for_state(State::silent));
  ASSERT_TRUE(run.wait_for_state(State::streaming)) << run.status().message;
  EXPECT_EQ(bed->claims(), 1);
}

TEST_F(LibertyOnUsb, WithoutSensorsItSaysSoAndWaits) {
  UsbTestbedOptions options;
  options.stations = 0;
  SET_UP(options);
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_message("no sensor is plugged in"));
  EXPECT_EQ(run.status().state, State::silent);
  bed->with_device([](LibertyEmulator& device) { device.plug_sensor(5); });
  ASSERT_TRUE(run.wait_for_frames(5));
  EXPECT_EQ(run.frames().back().samples[0].station, 5);
}

TEST_F(LibertyOnUsb, ADeafDeviceIsToldOf) {
  SET_UP();
  bed->with_device([](LibertyEmulator& device) { device.set_deaf(true); });
  bed->plug();
  Watched run;
  ASSERT_TRUE(run.wait_for_message("does not answer"));
  EXPECT_EQ(run.status().state, State::silent);
  bed->with_device([](LibertyEmulator& device) { device.set_deaf(false); });
  ASSERT_TRUE(run.wait_for_frames(5));
}

TEST_F(LibertyOnUsb, TheHemisphereIsSetInTheSourcesAxes) {
  SET_UP();
  bed->with_device([](LibertyEmulator& device) { device.set_pose(1, {5, 0, -10, 0, 0, 0}); });
  bed->plug();
  LibertyOptions options;
  options.hemisphere = Vec3(0, 0, 1);  // above the source, which for the device is -Z
  Watched run(options);
  ASSERT_TRUE(run.wait_for_frames(5));
  EXPECT_NEAR(run.frames().back().samples[0].position.z, 0.254, 1e-6);
}

}  // namespace
}  // namespace posed::tracker
