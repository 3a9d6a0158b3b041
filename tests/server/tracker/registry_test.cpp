#include "server/tracker/registry.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace posed::tracker {
namespace {

Nanoseconds no_time() {
  return 0;
}

TEST(Registry, MakesWhatItServes) {
  for (const char* spec : {"simulated", "simulated:7", "simulated:7@120", "simulated:@60"}) {
    const auto tracker = make_tracker(spec, no_time);
    ASSERT_TRUE(tracker) << spec;
    EXPECT_EQ((*tracker)->kind(), "simulated");
    EXPECT_EQ((*tracker)->id(), "simulated");
  }
  for (const char* spec :
       {"liberty", "liberty:usb", "liberty:/dev/ttyUSB0", "patriot", "patriot:/dev/ttyS0@57600", "fastrak:usb",
        "fastrak:/dev/serial/by-id/usb-FTDI@home-if00-port0@19200", "isotrak:/dev/ttyS0", "viper", "viper:usb",
        "spacemouse", "liberty:usb:1-2.3", "viper:usb:4711", "spacemouse:usb:A1"}) {
    const auto tracker = make_tracker(spec, no_time);
    ASSERT_TRUE(tracker) << spec << ": " << tracker.error().message;
    EXPECT_EQ((*tracker)->kind(), std::string(spec).substr(0, (*tracker)->kind().size()));
    EXPECT_EQ((*tracker)->id(), (*tracker)->kind());
  }
}

TEST(Registry, APlaceThatCannotBeIsRefusedWithTheCure) {
  for (const char* spec :
       {"liberty:ttyS0", "fastrak:/dev/ttyS0@", "fastrak:/dev/ttyS0@fast", "fastrak:/dev/ttyS0@0", "patriot:@9600",
        "isotrak", "isotrak:usb", "viper:/dev/ttyS0", "liberty:usb:", "isotrak:usb:1-1"}) {
    const auto tracker = make_tracker(spec, no_time);
    ASSERT_FALSE(tracker) << spec;
    EXPECT_EQ(tracker.error().code, "invalid_params") << spec;
    EXPECT_NE(tracker.error().hint, "") << spec;
  }
}

TEST(Registry, EveryKindIsServed) {
  for (const std::string_view kind : tracker_kinds()) {
    const auto tracker = make_tracker(kind, no_time);
    EXPECT_TRUE(tracker || tracker.error().code == "invalid_params") << kind;  // those that need a place
  }
  EXPECT_EQ(tracker_kinds().size(), 8u);
}

TEST(Registry, ACaptureNeedsAFolderThatIsThere) {
  TrackerOptions options;
  options.capture_folder = "/nowhere/at/all";
  EXPECT_EQ(make_tracker("liberty", no_time, options).error().code, "not_available");
  options.capture_folder = testing::TempDir() + "registry_captures";
  std::filesystem::remove_all(options.capture_folder);
  std::filesystem::create_directories(options.capture_folder);
  EXPECT_TRUE(make_tracker("fastrak", no_time, options));
  const auto made = std::filesystem::directory_iterator(options.capture_folder)->path();
  EXPECT_TRUE(made.filename().string().starts_with("fastrak-")) << made;
  EXPECT_EQ(made.extension(), ".capture");
  std::filesystem::remove_all(options.capture_folder);
}

TEST(Registry, RefusesTheRestWithTheList) {
  for (const char* spec : {"", "libertyy", "mouse:3", ":usb"}) {
    const auto tracker = make_tracker(spec, no_time);
    ASSERT_FALSE(tracker) << spec;
    EXPECT_EQ(tracker.error().code, "invalid_params");
    EXPECT_NE(tracker.error().message.find("spacemouse"), std::string::npos) << tracker.error().message;
  }
  EXPECT_EQ(make_tracker("libertyy", no_time).error().hint, "did you mean liberty?");
  for (const char* spec : {"simulated:x", "simulated:1@0", "simulated:1@5000", "simulated:-1", "simulated:1@"}) {
    const auto tracker = make_tracker(spec, no_time);
    ASSERT_FALSE(tracker) << spec;
    EXPECT_EQ(tracker.error().code, "invalid_params");
  }
}

}  // namespace
}  // namespace posed::tracker
