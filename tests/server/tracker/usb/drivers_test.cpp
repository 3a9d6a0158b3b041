// What only some trackers do, on USB.
#include <gtest/gtest.h>

#include <cerrno>
#include <memory>

#include "server/tracker/registry.h"
#include "tests/support/fastrak_emulator.h"
#include "tests/support/usb_testbed.h"
#include "tests/support/viper_emulator.h"
#include "tests/support/watched_tracker.h"

namespace posed::tracker {
namespace {

using test::UsbTestbed;
using test::UsbTestbedOptions;
using test::ViperEmulator;
using test::WatchedTracker;

std::unique_ptr<UsbTestbed> fastrak() {
  UsbTestbedOptions options;
  options.product = 0x0002;
  options.endpoints = "82 02 84i 04";
  options.out = 0x02;
  options.in = 0x82;
  options.stream = 0x84;
  options.packet = 64;
  options.make_device = [] { return std::make_unique<test::FastrakEmulator>(); };
  std::string reason;
  return UsbTestbed::make(std::move(options), reason);
}

std::unique_ptr<UsbTestbed> viper(int packet) {
  UsbTestbedOptions options;
  options.product = 0xbf01;
  options.endpoints = "81 02";
  options.out = 0x02;
  options.in = 0x81;
  options.packet = packet;
  options.make_device = [] { return std::make_unique<ViperEmulator>(); };
  std::string reason;
  return UsbTestbed::make(std::move(options), reason);
}

TEST(FastrakOnUsb, AStallOfEitherEndpointIsGotOver) {
  const auto bed = fastrak();
  ASSERT_TRUE(bed);
  bed->plug();
  WatchedTracker run("fastrak");
  for (const int error : {EPIPE, EOVERFLOW, EPIPE}) {
    ASSERT_TRUE(run.wait_for_frames(20)) << run.status().message;
    bed->fail_next_stream_read(error);
    bed->fail_next_read(error);
  }
  ASSERT_TRUE(run.wait_for_frames(20)) << run.status().message;
  EXPECT_EQ(bed->claims(), 1);
}

TEST(FastrakOnUsb, WithoutFirmwareTheCureIsTold) {
  UsbTestbedOptions options;
  options.product = 0x0001;
  std::string reason;
  const auto bed = UsbTestbed::make(std::move(options), reason);
  ASSERT_TRUE(bed);
  bed->plug();
  WatchedTracker run("fastrak");
  ASSERT_TRUE(run.wait_for_message("FastrakUSB.hex"));
  EXPECT_EQ(bed->claims(), 0);
}

TEST(ViperOnUsb, ARefusalIsTold) {
  const auto bed = viper(64);
  ASSERT_TRUE(bed);
  bed->with<ViperEmulator>([](ViperEmulator& device) { device.set_refusing(7); });
  bed->plug();
  WatchedTracker run("viper");
  ASSERT_TRUE(run.wait_for_message("the tracker refuses command 7: not today"));
  ASSERT_TRUE(run.wait_for_state(State::silent));
  bed->with<ViperEmulator>([](ViperEmulator& device) { device.set_refusing(-1); });
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  EXPECT_EQ(run.status().message, "");
}

TEST(ViperOnUsb, WhatIsAskedOfTheDeviceIsToldIt) {
  for (const bool old : {false, true}) {
    const auto bed = viper(64);
    ASSERT_TRUE(bed);
    bed->with<ViperEmulator>([&](ViperEmulator& device) { device.set_old_hemispheres(old); });
    bed->plug();
    WatchedTracker run("viper");
    ASSERT_TRUE(run.wait_for_stations(2)) << run.status().message;
    Settings settings;
    settings.rate_hz = 120.0;
    settings.hemispheres[1] = Vec3(0, 1, 0);
    settings.hemispheres[2] = kZero;
    settings.position_filter = FilterSetting{};
    settings.attitude_filter = FilterSetting{true, 0.125, 0.25, 0.75, 0.5};
    ASSERT_TRUE(run.configure(settings));
    ASSERT_TRUE(run.wait([&] { return run.last_status().rate_hz == 120; }));
    bed->with<ViperEmulator>([](ViperEmulator& device) {
      EXPECT_EQ(device.hemisphere(1), (std::array<double, 3>{0, -1, 0})) << "the source's Y points to the right";
      EXPECT_EQ(device.hemisphere(2), (std::array<double, 3>{0, 0, 0})) << "it follows";
      EXPECT_EQ(device.filter(2).level, 0u);
      EXPECT_EQ(device.filter(1).level, 4u);
      EXPECT_EQ(device.filter(1).numbers, (std::array<float, 4>{0.125f, 0.25f, 0.75f, 0.5f}));
    });
    ASSERT_TRUE(run.wait_for_frames(20));
    EXPECT_EQ(run.status().message, "");
    // Counted at the rate that was asked for.
    const std::vector<Frame> frames = run.frames();
    const Sample& last = frames.back().samples[0];
    EXPECT_EQ(last.device_t_ns, Nanoseconds{last.device_count} * 1'000'000'000 / 120);
    Settings reset;
    reset.reset = true;
    ASSERT_TRUE(run.configure(reset));
    ASSERT_TRUE(run.wait([&] { return run.last_status().rate_hz == 240; }));
    bed->with<ViperEmulator>([](ViperEmulator& device) {
      EXPECT_EQ(device.hemisphere(2), (std::array<double, 3>{1, 0, 0}));
      EXPECT_EQ(device.filter(2).numbers[0], 0.05f) << "medium, as from the factory";
    });
  }
}

TEST(ViperOnUsb, ARefusedSettingIsToldAndTheStreamGoesOn) {
  const auto bed = viper(64);
  ASSERT_TRUE(bed);
  bed->with<ViperEmulator>([](ViperEmulator& device) { device.set_refusing(1); });
  bed->plug();
  WatchedTracker run("viper");
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  Settings settings;
  settings.attitude_filter = FilterSetting{};
  ASSERT_TRUE(run.configure(settings));
  ASSERT_TRUE(run.wait_for_message("the tracker refuses attitude_filter: not today"));
  ASSERT_TRUE(run.wait_for_frames(5));
  EXPECT_EQ(run.status().state, State::streaming);
}

TEST(ViperOnUsb, BothButtonsAreHeard) {
  const auto bed = viper(64);
  ASSERT_TRUE(bed);
  bed->plug();
  WatchedTracker run("viper");
  for (const std::uint32_t held : {1u, 3u, 2u, 0u}) {
    bed->with<ViperEmulator>([&](ViperEmulator& device) { device.press_buttons(2, held); });
    ASSERT_TRUE(run.wait_for_frame([&](const Frame& frame) {
      return frame.samples.size() == 2 && frame.samples[1].buttons == held && frame.samples[0].buttons == 0;
    }));
  }
}

// Its 32 bytes fill a packet of 32: only an empty one tells the device that no more comes.
TEST(ViperOnUsb, ACommandThatFillsItsPacketsIsEnded) {
  const auto bed = viper(32);
  ASSERT_TRUE(bed);
  bed->plug();
  WatchedTracker run("viper");
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  EXPECT_GE(bed->empty_writes(), 4);
}

}  // namespace
}  // namespace posed::tracker
