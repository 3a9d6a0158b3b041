// The port and the driver on files that stand for the kernel's: a description as sysfs has it, a FIFO as the node.
#include "server/tracker/spacemouse/port.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "server/tracker/driver.h"
#include "server/tracker/spacemouse/session.h"
#include "tests/support/watched_tracker.h"

namespace posed::tracker {
namespace {

namespace fs = std::filesystem;

class SpacemousePortTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = fs::temp_directory_path() / "hidraw-XXXXXX";
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    top_ = pattern;
    fs::create_directories(top_ / "dev");
    fs::create_directories(top_ / "class");
  }
  void TearDown() override {
    if (writer_ >= 0) ::close(writer_);
    fs::remove_all(top_);
  }

  HidrawPaths paths() const { return {top_ / "dev", top_ / "class"}; }
  void describe(const std::string& node, const std::string& id, const std::string& port = "",
                const std::string& serial = "") {
    fs::create_directories(top_ / "class" / node / "device");
    std::ofstream(top_ / "class" / node / "device" / "uevent")
        << "DRIVER=hid-generic\nHID_ID=" << id << "\nHID_NAME=x\nHID_PHYS=" << port << "/input0\nHID_UNIQ=" << serial
        << "\n";
  }
  void plug(const std::string& node, const std::string& id) {
    const std::string path = top_ / "dev" / node;
    ::mkfifo(path.c_str(), 0600);
    writer_ = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    describe(node, id);
  }
  // The writer holds the reading end, too, so that nothing but pull() hangs up; the driver reads the last of what is
  // there.
  void pull(const std::string& node) {
    fs::remove_all(top_ / "class" / node);
    fs::remove(top_ / "dev" / node);
    ::close(std::exchange(writer_, -1));
  }
  // One read is to be one report: each waits until the one before it was read.
  void report(const std::vector<std::uint8_t>& bytes) {
    for (int left = 1, i = 0; left > 0 && i < 5000; ++i) {
      ::ioctl(writer_, FIONREAD, &left);
      if (left > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_EQ(::write(writer_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  std::unique_ptr<Tracker> driver(TimeSource now) {
    return std::make_unique<Driver>(DriverParts{"spacemouse", "spacemouse", 60,
                                                std::make_unique<SpacemousePort>(std::move(now), "", paths()), nullptr,
                                                [] { return std::make_unique<SpacemouseSession>("spacemouse"); }});
  }

  fs::path top_;
  int writer_ = -1;
};

TEST_F(SpacemousePortTest, IsFoundHeardPulledAndFoundAgain) {
  test::WatchedTracker run([&](TimeSource now) { return driver(std::move(now)); });
  ASSERT_TRUE(run.wait_for_message("no SpaceMouse is plugged in"));
  for (int round = 0; round < 2; ++round) {
    plug("hidraw3", "0003:0000046D:0000C626");
    ASSERT_TRUE(run.wait_for_state(State::streaming)) << run.status().message;
    const std::size_t before = run.frames().size();
    for (int i = 0; i < 20; ++i) {
      report({1, 0x5e, 0x01, 0, 0, 0, 0});
      report({2, 0, 0, 0, 0, 0x5e, 0x01});
    }
    ASSERT_TRUE(run.wait([&] { return run.last_frames().size() >= before + 40; }));
    pull("hidraw3");
    ASSERT_TRUE(run.wait_for_state(State::searching));
  }
  run.stop();
  EXPECT_LT(run.frames().back().samples[0].position.y, run.frames().front().samples[0].position.y);
}

TEST_F(SpacemousePortTest, SilenceIsNoTrouble) {
  plug("hidraw0", "0003:0000256F:0000C635");
  test::WatchedTracker run([&](TimeSource now) { return driver(std::move(now)); });
  ASSERT_TRUE(run.wait_for_state(State::streaming));
  // Longer than what would be trouble elsewhere; the status comes round about once a second.
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  EXPECT_EQ(run.status().state, State::streaming);
  EXPECT_EQ(run.status().message, "");
}

TEST_F(SpacemousePortTest, OtherDevicesAreLeftAlone) {
  describe("hidraw0", "0003:0000046D:0000C52B");  // a receiver of mice
  describe("hidraw1", "0003:0000256F:0000C650");  // a mouse without a cap
  describe("hidraw2", "0005:0000054C:000009CC");
  describe("hidraw3", "nonsense");
  SpacemousePort port([] { return Nanoseconds{0}; }, "", paths());
  const Opened opened = port.open([] { return false; });
  EXPECT_FALSE(opened.line);
  EXPECT_EQ(opened.state, State::searching);
}

// As a receiver shows itself: a keyboard of sorts first, then the cap.
TEST_F(SpacemousePortTest, TheInterfaceWithTheCapIsTaken) {
  plug("hidraw5", "0003:0000256F:0000C652");
  std::ofstream(top_ / "class/hidraw5/device/report_descriptor", std::ios::binary) << "\x05\x01\x09\x08\xa1\x01";
  describe("hidraw4", "0003:0000256F:0000C652");
  std::ofstream(top_ / "class/hidraw4/device/report_descriptor", std::ios::binary) << "\x05\x01\x09\x06\xa1\x01";
  SpacemousePort port([] { return Nanoseconds{0}; }, "", paths());
  EXPECT_TRUE(port.open([] { return false; }).line);
}

// hidraw lets any number of readers in: two trackers must not both take the first.
TEST_F(SpacemousePortTest, TwoKeepTheirOwn) {
  const auto add = [&](const std::string& node, const std::string& port, const std::string& serial) {
    ::mkfifo((top_ / "dev" / node).c_str(), 0600);
    describe(node, "0003:0000256F:0000C635", port, serial);
  };
  const auto never = [] { return false; };
  const auto no_time = [] { return Nanoseconds{0}; };
  add("hidraw0", "usb-0000:00:14.0-1", "");
  add("hidraw1", "usb-0000:00:14.0-2", "B77");
  SpacemousePort first(no_time, "", paths()), second(no_time, "", paths()), third(no_time, "", paths());
  EXPECT_TRUE(first.open(never).line);
  EXPECT_TRUE(second.open(never).line);
  const Opened none = third.open(never);
  EXPECT_FALSE(none.line);
  EXPECT_NE(none.message.find("/dev/hidraw1 is another tracker's"), std::string::npos) << none.message;
  // The first is pulled out, and the second comes back under the first one's old name.
  fs::remove_all(top_ / "class/hidraw0");
  fs::remove_all(top_ / "class/hidraw1");
  add("hidraw0", "usb-0000:00:14.0-4", "B77");
  EXPECT_FALSE(first.open(never).line);
  EXPECT_TRUE(second.open(never).line);
  SpacemousePort named(no_time, "B77", paths()), elsewhere(no_time, "usb-0000:00:14.0-9", paths());
  EXPECT_TRUE(named.open(never).line) << "who asks for it by name gets it";
  const Opened wrong = elsewhere.open(never);
  EXPECT_FALSE(wrong.line);
  EXPECT_NE(wrong.message.find("spacemouse:usb:B77"), std::string::npos) << wrong.message;
}

TEST_F(SpacemousePortTest, ADescriptionWithoutANodeIsToldOf) {
  describe("hidraw0", "0003:0000256F:0000C635");
  SpacemousePort port([] { return Nanoseconds{0}; }, "", paths());
  const Opened opened = port.open([] { return false; });
  EXPECT_FALSE(opened.line);
  EXPECT_EQ(opened.state, State::failed);
  EXPECT_NE(opened.message.find("/dev/hidraw0 cannot be opened"), std::string::npos) << opened.message;
}

}  // namespace
}  // namespace posed::tracker
