// A station under a real kernel: who may open a tracker by posed's udev rules, and a cable that is pulled and plugged.
#include <gtest/gtest.h>

#include <grp.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>

#include "server/tracker/registry.h"
#include "tests/support/liberty_emulator.h"
#include "tests/support/usb_kernel_testbed.h"
#include "tests/support/watched_tracker.h"

namespace posed::tracker {
namespace {

using test::UsbKernelTestbed;

constexpr unsigned kNobody = 65534;

std::unique_ptr<UsbKernelTestbed> plugged_in(test::UsbTestbedOptions options = {}) {
  std::string reason;
  auto bed = UsbKernelTestbed::make(std::move(options), reason);
  EXPECT_TRUE(bed) << reason;
  if (bed) bed->plug();
  return bed;
}

// What print_tracker says of a LIBERTY when somebody who is not root runs it.
std::string said_to_nobody(gid_t group) {
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], 1);
    if (::setgroups(0, nullptr) != 0 || ::setgid(group) != 0 || ::setuid(kNobody) != 0) ::_exit(3);
    ::execl(POSED_PRINT_TRACKER, "print_tracker", "liberty", "20", nullptr);
    ::_exit(4);
  }
  ::close(ends[1]);
  std::string text;
  char part[4096];
  // Where it is refused it goes on asking.
  pollfd said{ends[0], POLLIN, 0};
  while (text.find(".rules") == std::string::npos && ::poll(&said, 1, 20000) == 1) {
    const ssize_t n = ::read(ends[0], part, sizeof part);
    if (n <= 0) break;
    text.append(part, static_cast<std::size_t>(n));
  }
  ::kill(child, SIGTERM);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(ends[0]);
  return text;
}

std::size_t open_files() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

TEST(StationOnKernel, TheRulesGiveEveryTrackerToItsGroup) {
  const group* plugdev = ::getgrnam("plugdev");
  ASSERT_NE(plugdev, nullptr);
  for (const unsigned product : {0x0002u, 0xef12u, 0xef20u, 0xff12u, 0xff20u, 0xbf01u, 0xff21u}) {
    test::UsbTestbedOptions options;
    options.product = static_cast<std::uint16_t>(product);
    const auto bed = plugged_in(options);
    ASSERT_TRUE(bed);
    // The node is there before the rules have been gone through.
    struct stat node {};
    for (int i = 0; i < 1000; ++i) {
      ASSERT_EQ(::stat(bed->node().c_str(), &node), 0);
      if (node.st_gid == plugdev->gr_gid && (node.st_mode & 0777) == 0660) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(node.st_gid, plugdev->gr_gid) << std::hex << product;
    EXPECT_EQ(node.st_mode & 0777u, 0660u) << std::hex << product;
  }
}

TEST(StationOnKernel, OneOfTheGroupMeasures) {
  const auto bed = plugged_in();
  ASSERT_TRUE(bed);
  const std::string said = said_to_nobody(::getgrnam("plugdev")->gr_gid);
  EXPECT_NE(said.find("liberty:2"), std::string::npos) << said;
}

TEST(StationOnKernel, AnybodyElseIsToldTheCure) {
  const auto bed = plugged_in();
  ASSERT_TRUE(bed);
  const std::string said = said_to_nobody(kNobody);
  EXPECT_EQ(said.find("liberty:1"), std::string::npos) << said;
  EXPECT_NE(said.find("60-posed-trackers.rules"), std::string::npos) << said;
}

TEST(StationOnKernel, PulledAndPluggedAgainAndAgain) {
  const char* often = std::getenv("POSED_REPLUGS");
  const int times = often ? std::atoi(often) : 10;
  const auto bed = plugged_in();
  ASSERT_TRUE(bed);
  test::WatchedTracker run([](TimeSource now) { return std::move(*make_tracker("liberty", std::move(now))); });
  std::size_t files = 0;
  for (int i = 0; i < times; ++i) {
    ASSERT_TRUE(run.wait_for_frames(5)) << i << " " << run.status().message;
    bed->pull();
    bed->plug();
    if (i == 4) files = open_files();
  }
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  if (times > 5) {
    EXPECT_LE(open_files(), files + 2);
  }
  run.stop();
  EXPECT_FALSE(bed->held());
}

}  // namespace
}  // namespace posed::tracker
