// What only some trackers do, at a serial port.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "server/tracker/registry.h"
#include "tests/support/fastrak_emulator.h"
#include "tests/support/liberty_emulator.h"
#include "tests/support/pty_testbed.h"
#include "tests/support/watched_tracker.h"

namespace posed::tracker {
namespace {

using test::FastrakEmulator;
using test::LibertyEmulator;
using test::PtyTestbed;

struct Watched : test::WatchedTracker {
  Watched(const std::string& kind, const PtyTestbed& bed, const std::string& after = "")
      : WatchedTracker(kind + ":" + bed.place() + after) {}
};

struct Carried {
  int sensors;
  std::string baud;
  int rate_code, rate_hz;
  bool fits;
};

TEST(LibertyOnSerial, TheRateIsWhatTheLineCarries) {
  for (const Carried& c : {Carried{1, "@115200", 4, 240, true},
                           {2, "", 3, 120, true},
                           {3, "", 3, 120, false},
                           {1, "@57600", 3, 120, true},
                           {1, "@38400", 3, 120, false}}) {
    PtyTestbed bed(std::make_unique<LibertyEmulator>(c.sensors));
    bed.plug();
    Watched run("liberty", bed, c.baud);
    ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
    EXPECT_EQ(run.status().rate_hz, c.rate_hz);
    bed.with<LibertyEmulator>([&](LibertyEmulator& device) { EXPECT_EQ(device.rate_code(), c.rate_code); });
    EXPECT_EQ(run.status().message.find("baud do not carry") == std::string::npos, c.fits) << run.status().message;
    run.stop();
    // The device's own time counts with the rate that was chosen.
    const Sample sample = run.frames().back().samples[0];
    EXPECT_EQ(sample.device_t_ns, Nanoseconds{sample.device_count} * 1'000'000'000 / c.rate_hz);
  }
}

TEST(LibertyOnSerial, WhatIsAskedOfTheDeviceIsToldIt) {
  PtyTestbed bed(std::make_unique<LibertyEmulator>(2));
  bed.with<LibertyEmulator>([](LibertyEmulator& device) { device.write("X0.5,0.4,0.6,0.7\r"); });
  bed.plug();
  Watched run("liberty", bed);
  ASSERT_TRUE(run.wait_for_stations(2)) << run.status().message;
  bed.with<LibertyEmulator>(
      [](LibertyEmulator& device) { EXPECT_EQ(device.filter('X')[0], 0.5) << "what somebody has set in it stays"; });
  Settings settings;
  settings.stations = std::vector<int>{2};
  settings.hemispheres[2] = Vec3(0, 1, 0);
  settings.position_filter = FilterSetting{};
  settings.attitude_filter = FilterSetting{true, 0.1, 0.2, 0.8, 0.9};
  ASSERT_TRUE(run.configure(settings));
  ASSERT_TRUE(run.wait_for_frame([](const Frame& f) { return f.samples.size() == 1 && f.samples[0].station == 2; }));
  bed.with<LibertyEmulator>([](LibertyEmulator& device) {
    EXPECT_FALSE(device.active(1));
    EXPECT_EQ(device.hemisphere(2), (std::array<double, 3>{0, -1, 0})) << "the source's Y points to the right";
    EXPECT_EQ(device.hemisphere(1), (std::array<double, 3>{1, 0, 0}));
    EXPECT_EQ(device.filter('X'), (std::array<double, 4>{0, 1, 0, 0}));
    EXPECT_EQ(device.filter('Y'), (std::array<double, 4>{0.1, 0.2, 0.8, 0.9}));
  });
  // One sensor fits at the full rate; the half one can be asked for.
  ASSERT_TRUE(run.wait([&] { return run.last_status().rate_hz == 240; }));
  Settings slow;
  slow.rate_hz = 120.0;
  ASSERT_TRUE(run.configure(slow));
  ASSERT_TRUE(run.wait([&] { return run.last_status().rate_hz == 120; }));
  Settings reset;
  reset.reset = true;
  ASSERT_TRUE(run.configure(reset));
  ASSERT_TRUE(run.wait_for_stations(2));
  bed.with<LibertyEmulator>([](LibertyEmulator& device) {
    EXPECT_EQ(device.hemisphere(2), (std::array<double, 3>{1, 0, 0}));
    EXPECT_EQ(device.filter('Y'), (std::array<double, 4>{0, 1, 0, 0}));
  });
}

// An alignment in the device accumulates with each command: posed adds none, and takes none back.
TEST(LibertyOnSerial, AnAlignmentThatSomebodyHasMadeInItStays) {
  PtyTestbed bed(std::make_unique<LibertyEmulator>(1));
  bed.with<LibertyEmulator>([](LibertyEmulator& device) {
    device.set_pose(1, {10, 2, 3, 0, 0, 0});
    device.write("A1,1,0,0,1,1,0,0,0,0\r");  // X where Y was
    device.write("A1,1,0,0,2,0,0,1,1,0\r");  // one more inch along that
  });
  bed.plug();
  Watched run("liberty", bed);
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
    const Sample sample = run.frames().back().samples[0];
    EXPECT_NEAR(sample.position.x, (2 - 1) * 0.0254, 1e-6);
    EXPECT_NEAR(sample.position.y, (10 - 1) * 0.0254, 1e-6) << "its Y is to the right, ours to the left: -(-9)";
    EXPECT_NEAR(sample.position.z, -3 * 0.0254, 1e-6);
    bed.with_tracker([](test::TrackerEmulator& device) { device.stop_streaming(); });
    ASSERT_TRUE(run.wait_for_state(State::silent));
  }
}

TEST(FastrakOnSerial, TipAndBoresightOfTheDeviceAreItsOwn) {
  PtyTestbed bed(std::make_unique<FastrakEmulator>(1));
  bed.with<FastrakEmulator>([](FastrakEmulator& device) {
    device.set_pose(1, {10, 0, 0, 90, 0, 0});
    device.write("UN1,4,0,0\rB1\r");  // four inches along the sensor's X, which points to the source's Y
  });
  bed.plug();
  Watched run("fastrak", bed);
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  const Sample sample = run.frames().back().samples[0];
  EXPECT_NEAR(sample.position.x, 0.254, 1e-6);
  EXPECT_NEAR(sample.position.y, -4 * 0.0254, 1e-6);
  EXPECT_NEAR(std::abs(sample.rotation.w), 1.0, 1e-6);
}

TEST(LibertyOnSerial, WhatItHasNotIsRefusedByName) {
  PtyTestbed bed(std::make_unique<LibertyEmulator>(1));
  Watched liberty("liberty", bed), fastrak("fastrak", bed);
  const auto refused = [](Watched& run, const Settings& settings, const char* code, const char* path) {
    const auto taken = run.configure(settings);
    ASSERT_FALSE(taken);
    EXPECT_EQ(taken.error().code, code);
    EXPECT_EQ(taken.error().path, path);
    EXPECT_FALSE(taken.error().hint.empty());
  };
  Settings rate;
  rate.rate_hz = 1000.0;
  refused(liberty, rate, "out_of_range", "/rate_hz");
  refused(fastrak, rate, "not_available", "/rate_hz");
  Settings sensors;
  sensors.stations = std::vector<int>{1, 17};
  refused(liberty, sensors, "out_of_range", "/sensors/1");
  sensors.stations = std::vector<int>{};
  refused(liberty, sensors, "out_of_range", "/sensors");
  sensors.stations = std::vector<int>{1, 5};
  refused(fastrak, sensors, "out_of_range", "/sensors/1");
  Settings follow;
  follow.hemispheres[1] = kZero;
  refused(fastrak, follow, "out_of_range", "/hemisphere");
  EXPECT_TRUE(liberty.configure(follow));
  EXPECT_EQ(fastrak.configure(rate).error().hint, "it has sensors, hemisphere, position_filter, attitude_filter");
  const auto viper = std::move(*make_tracker("viper", [] { return Nanoseconds{0}; }));
  EXPECT_EQ(viper->configure(sensors).error().path, "/sensors");
  EXPECT_EQ(viper->configure(sensors).error().hint, "it has rate_hz, hemisphere, position_filter, attitude_filter");
  EXPECT_EQ(viper->configure(rate).error().hint, "30 or 60 or 120 or 240 or 480 or 960 Hz");
  Settings half;
  half.hemispheres[1] = Vec3(NAN, 0, 0);
  refused(liberty, half, "out_of_range", "/hemisphere");
}

TEST(FastrakOnSerial, TheStylusButtonIsHeardAndStopsNothing) {
  PtyTestbed bed(std::make_unique<FastrakEmulator>(2));
  bed.plug();
  Watched run("fastrak", bed);
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  for (const bool down : {true, false, true}) {
    bed.with<FastrakEmulator>([&](FastrakEmulator& device) { device.press_button(down); });
    ASSERT_TRUE(run.wait_for_frame([&](const Frame& frame) { return frame.samples[0].buttons == (down ? 1u : 0u); }));
  }
  EXPECT_TRUE(bed.streaming());
}

TEST(FastrakOnSerial, WhatIsAskedOfTheDeviceIsToldIt) {
  for (const auto& [kind, family] :
       {std::pair{"fastrak", FastrakEmulator::Kind::fastrak}, {"isotrak", FastrakEmulator::Kind::isotrak}}) {
    PtyTestbed bed(std::make_unique<FastrakEmulator>(2, family));
    bed.plug();
    Watched run(kind, bed);
    ASSERT_TRUE(run.wait_for_stations(2)) << run.status().message;
    bed.with<FastrakEmulator>(
        [](FastrakEmulator& device) { EXPECT_EQ(device.filter('x')[0], 0.2) << "what somebody has set in it stays"; });
    Settings settings;
    settings.stations = std::vector<int>{2};
    settings.hemispheres[2] = Vec3(0, 1, 0);
    settings.position_filter = FilterSetting{};
    settings.attitude_filter = FilterSetting{true, 0.1, 0.25, 0.75, 0.9};
    ASSERT_TRUE(run.configure(settings));
    ASSERT_TRUE(run.wait_for_frame([](const Frame& f) { return f.samples.size() == 1 && f.samples[0].station == 2; }));
    bed.with<FastrakEmulator>([](FastrakEmulator& device) {
      EXPECT_FALSE(device.active(1));
      EXPECT_EQ(device.hemisphere(2), (std::array<double, 3>{0, -1, 0})) << "the source's Y points to the right";
      EXPECT_EQ(device.filter('x'), (std::array<double, 4>{0, 1, 0, 0}));
      EXPECT_EQ(device.filter('v'), (std::array<double, 4>{0.1, 0.25, 0.75, 0.9}));
    });
    Settings reset;
    reset.reset = true;
    ASSERT_TRUE(run.configure(reset));
    ASSERT_TRUE(run.wait_for_stations(2)) << "those that were on at first";
    bed.with<FastrakEmulator>([](FastrakEmulator& device) {
      EXPECT_EQ(device.hemisphere(2), (std::array<double, 3>{1, 0, 0}));
      EXPECT_EQ(device.filter('v'), (std::array<double, 4>{0, 1, 0, 0}));
    });
    EXPECT_EQ(run.status().message, "") << kind;
  }
}

TEST(LibertyOnSerial, TheStylusButtonIsHeardAndStopsNothing) {
  for (const int sensors : {1, 2}) {  // the first fills the line: no room for the distortion, but for the button
    PtyTestbed bed(std::make_unique<LibertyEmulator>(sensors));
    bed.with<LibertyEmulator>([](LibertyEmulator& device) { device.write("L1,1\r"); });
    bed.plug();
    Watched run("liberty", bed);
    ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
    for (const bool down : {true, false, true}) {
      bed.with<LibertyEmulator>([&](LibertyEmulator& device) { device.press_button(1, down); });
      ASSERT_TRUE(run.wait_for_frame([&](const Frame& frame) { return frame.samples[0].buttons == (down ? 1u : 0u); }));
    }
    EXPECT_TRUE(bed.streaming());
  }
}

TEST(LibertyOnSerial, TheDistortionIsToldWhereTheLineHasRoom) {
  PtyTestbed bed(std::make_unique<LibertyEmulator>(1));
  bed.with<LibertyEmulator>([](LibertyEmulator& device) { device.set_distortion(1, 2); });
  bed.plug();
  Watched run("liberty", bed);
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  EXPECT_EQ(run.frames().back().samples[0].flags & kFlagDistorted, 0u);
  Settings slow;
  slow.rate_hz = 120.0;
  ASSERT_TRUE(run.configure(slow));
  ASSERT_TRUE(run.wait_for_frame([](const Frame& frame) { return (frame.samples[0].flags & kFlagDistorted) != 0; }));
}

TEST(FastrakOnSerial, AComplaintIsTold) {
  PtyTestbed bed(std::make_unique<FastrakEmulator>(1));
  bed.plug();
  Watched run("fastrak", bed);
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  bed.with_tracker([](test::TrackerEmulator& device) { device.write("k9\r"); });
  ASSERT_TRUE(run.wait_for_message("does not know (error -99)"));
  ASSERT_TRUE(run.wait_for_frames(5));
  run.stop();
  EXPECT_EQ(run.status().state, State::streaming);
  EXPECT_EQ(run.status().bad_bytes, 0u);
}

// On a busy machine its complaint of the CR that wakes it came after the silence, and stood in the status for good.
TEST(FastrakOnSerial, AComplaintOfWhatStoodHalfTypedIsForgottenThoughItComesLate) {
  auto slow = std::make_unique<FastrakEmulator>(1);
  slow->set_slow_to_complain();
  PtyTestbed bed(std::move(slow));
  bed.plug();
  Watched run("fastrak", bed);
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  EXPECT_EQ(run.status().message, "");
}

TEST(FastrakOnSerial, ReceiversThatAreSwitchedOffAreLeftOff) {
  PtyTestbed bed(std::make_unique<FastrakEmulator>(4));
  bed.with_tracker([](test::TrackerEmulator& device) { device.write("l2,0\rl4,0\r"); });
  bed.plug();
  Watched run("fastrak", bed);
  ASSERT_TRUE(run.wait_for_stations(2)) << run.status().message;
  EXPECT_EQ(run.status().rate_hz, 60);
  run.stop();
  EXPECT_EQ(run.frames().back().samples[1].station, 3);
}

TEST(FastrakOnSerial, WithoutReceiversItSaysSo) {
  PtyTestbed bed(std::make_unique<FastrakEmulator>(0));
  bed.plug();
  Watched run("fastrak", bed);
  ASSERT_TRUE(run.wait_for_message("no receiver is switched on"));
}

// At least the pauses that it promises; more where the machine is busy.
TEST(Driver, EachPauseIsLongerThanTheLast) {
  using Steady = std::chrono::steady_clock;
  PtyTestbed bed(std::make_unique<LibertyEmulator>(1));
  bed.with_tracker([](test::TrackerEmulator& device) { device.set_frozen(true); });
  bed.plug();
  std::mutex mutex;
  std::vector<std::pair<State, Steady::time_point>> states;
  const auto tracker = std::move(*make_tracker("liberty:" + bed.place(), [] { return Nanoseconds{0}; }));
  tracker->start({{}, [&](const Status& status) {
                    const std::lock_guard lock(mutex);
                    if (states.empty() || states.back().first != status.state) {
                      states.emplace_back(status.state, Steady::now());
                    }
                  }});
  // Searching, then starting and silent in turns.
  constexpr std::size_t kWanted = 6;
  for (int i = 0; i < 6000; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const std::lock_guard lock(mutex);
    if (states.size() >= kWanted) break;
  }
  tracker->stop();
  ASSERT_GE(states.size(), kWanted);
  EXPECT_EQ(states[2].first, State::silent);
  EXPECT_EQ(states[4].first, State::silent);
  EXPECT_GE(states[3].second - states[2].second, std::chrono::milliseconds(1000));
  EXPECT_GE(states[5].second - states[4].second, std::chrono::milliseconds(2000));
}

}  // namespace
}  // namespace posed::tracker
