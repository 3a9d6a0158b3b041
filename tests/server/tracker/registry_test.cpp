#include "server/tracker/registry.h"

#include <gtest/gtest.h>

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
  for (const char* spec : {"liberty", "liberty:usb"}) {
    const auto tracker = make_tracker(spec, no_time);
    ASSERT_TRUE(tracker) << spec;
    EXPECT_EQ((*tracker)->kind(), "liberty");
  }
}

TEST(Registry, SaysWhatIsNotServedYet) {
  for (const char* spec :
       {"patriot", "fastrak:/dev/ttyS0", "isotrak", "viper", "spacemouse", "replay:a.jsonl", "liberty:/dev/ttyUSB0"}) {
    const auto tracker = make_tracker(spec, no_time);
    ASSERT_FALSE(tracker) << spec;
    EXPECT_EQ(tracker.error().code, "not_available") << spec;
    EXPECT_FALSE(tracker.error().hint.empty());
  }
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
