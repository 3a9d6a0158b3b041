#include "tests/server/tracker/conformance/conformance.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <thread>
#include <vector>

#include "server/tracker/registry.h"
#include "tests/support/frames_text.h"
#include "tests/support/watched_tracker.h"

namespace posed::tracker {

using test::SourcePose;
using test::TrackerEmulator;
using test::WatchedTracker;

namespace {

constexpr double kInch = 0.0254;
const SourcePose kFirst{10.0, -2.5, 3.25, 45.0, -30.0, 15.0}, kSecond{20.0, 8.0, -6.0, -120.0, 10.0, -75.0};

}  // namespace

// The rotation is checked by where it takes the axes, worked out from the angles by the manual's matrix, so that no
// quaternion's convention can hide.
void Conformance::expect_pose(const Frame& frame, std::size_t index, const SourcePose& pose) const {
  ASSERT_LT(index, frame.samples.size());
  const Sample& sample = frame.samples[index];
  const double tolerance = GetParam().tolerance;
  EXPECT_NEAR(sample.position.x, pose.x * kInch, tolerance);
  EXPECT_NEAR(sample.position.y, -pose.y * kInch, tolerance);
  EXPECT_NEAR(sample.position.z, -pose.z * kInch, tolerance);
  double m[9];
  test::matrix_of(pose, m);
  const Vec3 forward = sample.rotation * kX, right = sample.rotation * -kY, down = sample.rotation * -kZ;
  const Vec3 axes[] = {forward, right, down};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(axes[axis].x, m[axis], 4 * tolerance);
    EXPECT_NEAR(-axes[axis].y, m[3 + axis], 4 * tolerance);
    EXPECT_NEAR(-axes[axis].z, m[6 + axis], 4 * tolerance);
  }
}

TEST_P(Conformance, StartsStreamsAndLeavesItQuiet) {
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_frames(60)) << run.status().message;
  EXPECT_EQ(run.status().state, State::streaming);
  EXPECT_EQ(run.status().message, "");
  EXPECT_GT(run.status().rate_hz, 0);
  EXPECT_TRUE(bed->held());
  run.stop();
  for (int i = 0; i < 1000 && bed->streaming(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(bed->streaming());
  EXPECT_FALSE(bed->held());
  EXPECT_EQ(run.status().bad_bytes, 0u);
  Nanoseconds before = 0;
  for (const Frame& frame : run.frames()) {
    EXPECT_EQ(frame.device, GetParam().kind);
    EXPECT_GE(frame.t_ns, before);
    before = frame.t_ns;
  }
  // The first may be of a cycle that had begun already.
  const std::vector<Frame> frames = run.frames();
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_EQ(frames[i].samples.size(), 2u) << i;
}

TEST_P(Conformance, UnitsAndAxes) {
  bed->with_tracker([](TrackerEmulator& device) {
    device.set_pose(1, kFirst);
    device.set_pose(2, kSecond);
  });
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_stations(2)) << run.status().message;
  run.stop();
  expect_pose(run.frames().back(), 0, kFirst);
  expect_pose(run.frames().back(), 1, kSecond);
  EXPECT_EQ(run.frames().back().samples[1].station, 2);
}

TEST_P(Conformance, FramesThatStraddleReads) {
  bed->carry_in_pieces(3);
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_frames(30)) << run.status().message;
  run.stop();
  EXPECT_EQ(run.status().bad_bytes, 0u);
  for (const Frame& frame : run.frames()) expect_pose(frame, 0, kFirst);
}

TEST_P(Conformance, GarbageInTheStream) {
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_frames(20)) << run.status().message;
  std::mt19937 dice(7);
  for (int burst = 0; burst < 10; ++burst) {
    std::string noise;
    for (int i = 0; i < 60; ++i) noise += static_cast<char>(dice() & 0xff);
    bed->inject(noise);
    ASSERT_TRUE(run.wait_for_frames(10)) << run.status().message;
  }
  ASSERT_TRUE(run.wait([&] { return run.last_status().bad_bytes > 0; }));
  run.stop();
  for (const Frame& frame : run.frames()) {
    for (std::size_t i = 0; i < frame.samples.size(); ++i) expect_pose(frame, i, kFirst);
  }
}

TEST_P(Conformance, AStreamThatACrashLeftBehind) {
  bed->with_tracker([](TrackerEmulator& device) { device.left_streaming(); });
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_frames(20)) << run.status().message;
  run.stop();
  for (const Frame& frame : run.frames()) expect_pose(frame, 0, kFirst);  // none in other units
}

TEST_P(Conformance, AnErrorLetterFlagsTheSample) {
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  EXPECT_EQ(run.frames().back().samples[0].flags & kFlagError, 0u);
  bed->with_tracker([](TrackerEmulator& device) { device.set_error_letter(1, 'C'); });
  ASSERT_TRUE(run.wait_for_frame([](const Frame& frame) { return (frame.samples[0].flags & kFlagError) != 0; }));
  run.stop();
  const char told = GetParam().told_letter;
  EXPECT_EQ(run.frames().back().samples[0].error_letter, told ? told : 'C');
  expect_pose(run.frames().back(), 0, kFirst);
}

TEST_P(Conformance, UnpluggedAndPluggedInAgain) {
  bed->plug();
  WatchedTracker run(spec());
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(run.wait_for_frames(10)) << run.status().message;
    bed->pull();
    ASSERT_TRUE(run.wait_for_state(State::searching));
    bed->plug();
  }
  ASSERT_TRUE(run.wait_for_frames(10)) << run.status().message;
  EXPECT_EQ(run.status().message, "");
}

TEST_P(Conformance, PluggedInLater) {
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait([&] { return !run.last_status().message.empty(); }));
  EXPECT_EQ(run.status().state, State::searching);
  bed->plug();
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
}

TEST_P(Conformance, StopsWhileUnplugged) {
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  bed->pull();
  run.stop();
}

// The watchdog: silence, then everything anew, in ever longer steps.
TEST_P(Conformance, AStreamThatDiesIsStartedAnew) {
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  bed->with_tracker([](TrackerEmulator& device) { device.stop_streaming(); });
  ASSERT_TRUE(run.wait_for_state(State::silent));
  EXPECT_NE(run.status().message, "");
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  EXPECT_EQ(run.status().state, State::streaming);
}

TEST_P(Conformance, SwitchedOffAndOnAtTheSameLine) {
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  bed->with_tracker([](TrackerEmulator& device) { device.power_cycle(); });
  ASSERT_TRUE(run.wait_for_state(State::silent));
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  run.stop();
  for (const Frame& frame : run.frames()) expect_pose(frame, 0, kFirst);
}

TEST_P(Conformance, ADeafOneIsToldOf) {
  bed->with_tracker([](TrackerEmulator& device) { device.set_deaf(true); });
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_message("does not answer"));
  ASSERT_TRUE(run.wait_for_state(State::silent));
  bed->with_tracker([](TrackerEmulator& device) { device.set_deaf(false); });
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
}

TEST_P(Conformance, AFrozenOneIsToldOf) {
  bed->with_tracker([](TrackerEmulator& device) { device.set_frozen(true); });
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_message("no data for 2 s"));
  bed->with_tracker([](TrackerEmulator& device) { device.set_frozen(false); });
  ASSERT_TRUE(run.wait_for_frames(5)) << run.status().message;
  EXPECT_EQ(run.status().message, "");
}

TEST_P(Conformance, SensorsComeAndGo) {
  bed->plug();
  WatchedTracker run(spec());
  ASSERT_TRUE(run.wait_for_stations(2)) << run.status().message;
  bed->with_tracker([](TrackerEmulator& device) { device.unplug_sensor(2); });
  ASSERT_TRUE(run.wait_for_stations(1));
  EXPECT_EQ(run.frames().back().samples[0].station, 1);
  bed->with_tracker([](TrackerEmulator& device) { device.plug_sensor(2); });
  ASSERT_TRUE(run.wait_for_stations(2));
  bed->with_tracker([](TrackerEmulator& device) { device.unplug_sensor(1); });
  ASSERT_TRUE(run.wait_for_frame([](const Frame& frame) { return frame.samples[0].station == 2; }));
}

// With noise and a stream that is started anew in it.
TEST_P(Conformance, ItsCaptureGivesTheSameFramesAgain) {
  namespace fs = std::filesystem;
  std::string folder = fs::temp_directory_path() / "captures-XXXXXX";
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  TrackerOptions options;
  options.capture_folder = folder;
  bed->plug();
  std::vector<Frame> frames;
  {
    test::WatchedTracker run([&](TimeSource now) { return std::move(*make_tracker(spec(), std::move(now), options)); });
    ASSERT_TRUE(run.wait_for_frames(10)) << run.status().message;
    bed->inject("noise of no tracker");
    ASSERT_TRUE(run.wait_for_frames(10)) << run.status().message;
    bed->with_tracker([](TrackerEmulator& device) { device.stop_streaming(); });
    ASSERT_TRUE(run.wait_for_state(State::silent));
    ASSERT_TRUE(run.wait_for_frames(10)) << run.status().message;
    run.stop();
    frames = run.frames();
  }
  const std::string file = fs::directory_iterator(folder)->path();
  WatchedTracker again("replay:" + file + "@fast");
  ASSERT_TRUE(again.wait_for_message("come to its end after " + std::to_string(frames.size()) + " frames"))
      << again.status().message;
  again.stop();
  const Nanoseconds shift = again.frames().front().t_ns - frames.front().t_ns;
  EXPECT_EQ(test::frames_text(again.frames(), shift), test::frames_text(frames, 0));
  fs::remove_all(folder);
}

}  // namespace posed::tracker
