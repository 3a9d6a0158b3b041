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

class Watched : public test::WatchedTracker {
 public:
  explicit Watched(const std::string& spec)
      : WatchedTracker([&](TimeSource now) { return std::move(*make_tracker(spec, std::move(now))); }) {}
};

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
  Watched run("fastrak");
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
  Watched run("fastrak");
  ASSERT_TRUE(run.wait_for_message("FastrakUSB.hex"));
  EXPECT_EQ(bed->claims(), 0);
}

TEST(ViperOnUsb, ARefusalIsTold) {
  const auto bed = viper(64);
  ASSERT_TRUE(bed);
  bed->with<ViperEmulator>([](ViperEmulator& device) { device.set_refusing(7); });
  bed->plug();
  Watched run("viper");
  ASSERT_TRUE(run.wait_for_message("the tracker refuses command 7: not today"));
  ASSERT_TRUE(run.wait_for_state(State::silent));
  bed->with<ViperEmulator>([](ViperEmulator& device) { device.set_refusing(-1); });
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  EXPECT_EQ(run.status().message, "");
}

// Its 32 bytes fill a packet of 32: only an empty one tells the device that no more comes.
TEST(ViperOnUsb, ACommandThatFillsItsPacketsIsEnded) {
  const auto bed = viper(32);
  ASSERT_TRUE(bed);
  bed->plug();
  Watched run("viper");
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  EXPECT_GE(bed->empty_writes(), 4);
}

}  // namespace
}  // namespace posed::tracker
