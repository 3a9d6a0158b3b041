#include "server/tracker/spacemouse/decoder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace posed::tracker {
namespace {

using Report = std::vector<std::uint8_t>;

constexpr Nanoseconds kPeriod = 8'000'000;

Report motion(int id, std::initializer_list<int> numbers) {
  Report report{static_cast<std::uint8_t>(id)};
  for (const int v : numbers) {
    report.push_back(static_cast<std::uint8_t>(v & 0xff));
    report.push_back(static_cast<std::uint8_t>(v >> 8 & 0xff));
  }
  return report;
}

struct Pushed {
  SpacemouseDecoder decoder{SpacemouseFormat{}};
  Nanoseconds now = 0;
  Sample last;

  void feed(const Report& report) {
    now += kPeriod;
    for (const Frame& frame : decoder.feed(report, now).frames) {
      EXPECT_EQ(frame.t_ns, now);
      EXPECT_EQ(frame.device, "spacemouse");
      ASSERT_EQ(frame.samples.size(), 1u);
      last = frame.samples[0];
    }
  }
  Vec3 start() {
    feed(motion(1, {0, 0, 0}));
    return last.position;
  }
};

// Its X is to the right, Y towards the user, Z down.
TEST(SpacemouseDecoder, APushMovesThatWay) {
  const Vec3 ways[] = {-kY, -kX, -kZ};
  for (int axis = 0; axis < 3; ++axis) {
    Pushed mouse;
    const Vec3 start = mouse.start();
    // A second, as far as it goes.
    for (int i = 0; i < 125; ++i)
      mouse.feed(motion(1, {axis == 0 ? 350 : 0, axis == 1 ? 350 : 0, axis == 2 ? 350 : 0}));
    EXPECT_NEAR(glm::length(mouse.last.position - start - 0.4 * ways[axis]), 0, 1e-9) << axis;
  }
}

TEST(SpacemouseDecoder, ATwistTurnsAboutTheSameAxis) {
  Pushed mouse;
  for (int i = 0; i < 125; ++i) mouse.feed(motion(2, {0, 0, 350}));
  // About its Z, which points down.
  EXPECT_NEAR(std::abs(mouse.last.rotation.w), std::cos(0.75), 1e-9);
  EXPECT_NEAR(mouse.last.rotation.z / mouse.last.rotation.w, -std::tan(0.75), 1e-9);
  EXPECT_NEAR(glm::length(mouse.last.rotation), 1.0, 1e-12);
}

TEST(SpacemouseDecoder, OneLongReportIsWorthTwoShortOnes) {
  Pushed split, whole;
  for (int i = 0; i < 10; ++i) {
    whole.now = split.now = i * 10 * kPeriod;
    split.feed(motion(1, {10, -20, 30}));
    split.now -= kPeriod;
    split.feed(motion(2, {-40, 50, 60}));
    whole.feed(motion(1, {10, -20, 30, -40, 50, 60}));
  }
  EXPECT_EQ(split.last.position, whole.last.position);
  EXPECT_EQ(split.last.rotation, whole.last.rotation);
}

TEST(SpacemouseDecoder, ItStaysWhereItIsLeft) {
  Pushed mouse;
  for (int i = 0; i < 10; ++i) mouse.feed(motion(1, {100, 0, 0}));
  for (int i = 0; i < 3; ++i) mouse.feed(motion(1, {0, 0, 0}));
  const Vec3 left = mouse.last.position;
  mouse.now += 60'000'000'000;  // a minute of silence
  mouse.feed(motion(1, {350, 0, 0}));
  EXPECT_NEAR(glm::length(mouse.last.position - left), 0.4 * 0.008, 1e-9);  // and not a minute's worth
}

TEST(SpacemouseDecoder, ItCannotBeLost) {
  Pushed mouse;
  for (int i = 0; i < 10000; ++i) mouse.feed(motion(1, {32767, -32768, 350}));
  for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(mouse.last.position[axis]), 3.0);
}

TEST(SpacemouseDecoder, ButtonsAndTheWayHome) {
  Pushed mouse;
  const Vec3 home = mouse.start();
  for (int i = 0; i < 10; ++i) mouse.feed(motion(1, {100, 50, 20, 7, 8, 9}));
  mouse.feed({3, 1, 0});
  EXPECT_EQ(mouse.last.buttons, 1u);
  EXPECT_NE(mouse.last.position, home);
  mouse.feed({3, 3, 0});
  EXPECT_EQ(mouse.last.position, home);
  EXPECT_NEAR(std::abs(mouse.last.rotation.w), 1.0, 1e-12);
  mouse.feed({3, 0, 0x10, 0x40, 0});
  EXPECT_EQ(mouse.last.buttons, 1u << 12 | 1u << 22);
}

TEST(SpacemouseDecoder, OtherReportsAreNoneAndBrokenOnesAreCounted) {
  SpacemouseDecoder d{SpacemouseFormat{}};
  EXPECT_TRUE(d.feed(Report{0x17, 80, 0}, 1).frames.empty());  // the battery
  EXPECT_EQ(d.bad_bytes(), 0u);
  EXPECT_TRUE(d.feed(Report{1, 2, 3}, 1).frames.empty());
  EXPECT_TRUE(d.feed(Report{}, 1).frames.empty());
  EXPECT_EQ(d.bad_bytes(), 3u);
}

}  // namespace
}  // namespace posed::tracker
