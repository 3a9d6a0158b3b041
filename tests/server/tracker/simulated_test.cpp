#include "server/tracker/simulated.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace posed::tracker {
namespace {

TEST(Simulated, TheSameSeedMovesTheSame) {
  SimulatedOptions options;
  for (const std::uint64_t count : {0ull, 1ull, 1000ull, 1ull << 33}) {
    const Frame a = simulated_frame(options, count), b = simulated_frame(options, count);
    ASSERT_EQ(a.samples.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(a.samples[i].position, b.samples[i].position);
      EXPECT_EQ(a.samples[i].rotation, b.samples[i].rotation);
    }
  }
  SimulatedOptions other;
  other.seed = 2;
  EXPECT_NE(simulated_frame(options, 5).samples[0].position, simulated_frame(other, 5).samples[0].position);
}

TEST(Simulated, StaysWithinReachAndMovesSmoothly) {
  const SimulatedOptions options;
  Frame last = simulated_frame(options, 0);
  for (std::uint64_t count = 1; count < 240 * 120; ++count) {
    Frame frame = simulated_frame(options, count);
    for (std::size_t i = 0; i < 2; ++i) {
      const Sample& s = frame.samples[i];
      const double y = i == 0 ? s.position.y : -s.position.y;
      EXPECT_GE(s.position.x, 0.35);
      EXPECT_LE(s.position.x, 0.55);
      EXPECT_GE(y, -0.45);
      EXPECT_LE(y, -0.05);
      EXPECT_GE(s.position.z, 0.9);
      EXPECT_LE(s.position.z, 1.5);
      EXPECT_NEAR(glm::length(s.rotation), 1.0, 1e-12);
      EXPECT_LT(glm::length(s.position - last.samples[i].position), 0.004);
      EXPECT_GT(glm::dot(s.rotation, last.samples[i].rotation), 0.999);
    }
    last = std::move(frame);
  }
}

struct Heard {
  std::mutex mutex;
  std::condition_variable wake;
  std::vector<Frame> frames;
  Sink sink() {
    return {[this](Frame frame) {
              const std::lock_guard lock(mutex);
              frames.push_back(std::move(frame));
              wake.notify_all();
            },
            [](const Status&) {}};
  }
  bool wait_for(std::size_t count) {
    std::unique_lock lock(mutex);
    return wake.wait_for(lock, std::chrono::seconds(20), [&] { return frames.size() >= count; });
  }
};

TEST(Simulated, FramesAreThoseOfTheirTick) {
  const Clock clock;
  Heard heard;
  SimulatedTracker tracker({}, [&] { return clock.now(); });
  tracker.start(heard.sink());
  ASSERT_TRUE(heard.wait_for(50));
  tracker.stop();
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < heard.frames.size(); ++i) {
    const Frame& frame = heard.frames[i];
    const std::uint32_t count = frame.samples[0].device_count;
    EXPECT_EQ(frame.samples[0].position, simulated_frame({}, count).samples[0].position);
    EXPECT_TRUE(i == 0 || count > last);
    last = count;
    // Never before its time: the tick's own, from the first frame's.
    EXPECT_GE(frame.t_ns - heard.frames[0].t_ns, frame.samples[0].device_t_ns - 4'166'667);
  }
}

TEST(Simulated, CatchesUpBySkippingNotByABurst) {
  std::atomic<Nanoseconds> now{0};
  Heard heard;
  SimulatedTracker tracker({}, [&] { return now.load(); });
  tracker.start(heard.sink());
  ASSERT_TRUE(heard.wait_for(1));
  now = 10'000'000'000;  // ten seconds late
  ASSERT_TRUE(heard.wait_for(2));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  tracker.stop();
  ASSERT_EQ(heard.frames.size(), 2u);
  EXPECT_EQ(heard.frames[1].samples[0].device_count, 2400u);
}

TEST(Simulated, StopsBeforeItIsStarted) {
  SimulatedTracker tracker({}, [] { return Nanoseconds{0}; });
  tracker.stop();
}

}  // namespace
}  // namespace posed::tracker
