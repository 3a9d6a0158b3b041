// What was captured comes back as the same Frames, by the same decoder.
#include "server/tracker/capture/replay.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <random>

#include "server/tracker/capture/capture.h"
#include "server/tracker/capture/decoders.h"
#include "server/tracker/fastrak/decoder.h"
#include "server/tracker/isotrak/decoder.h"
#include "server/tracker/liberty/decoder.h"
#include "server/tracker/registry.h"
#include "server/tracker/spacemouse/decoder.h"
#include "server/tracker/viper/decoder.h"
#include "tests/support/fastrak_emulator.h"
#include "tests/support/frames_text.h"
#include "tests/support/liberty_emulator.h"
#include "tests/support/viper_emulator.h"
#include "tests/support/watched_tracker.h"

namespace posed::tracker {
namespace {

using test::Bytes;

constexpr Nanoseconds kMillisecond = 1'000'000;

struct Replay : testing::Test {
  std::string path = testing::TempDir() + "replay_test.capture";
  void SetUp() override { std::filesystem::remove(path); }
  void TearDown() override { std::filesystem::remove(path); }

  void write(const std::string& text) { std::ofstream(path, std::ios::binary) << text; }
};

// Chunks of any size, with noise between them and some lost, as a bad line brings them.
void capture_dirty_line(Decoder& decoder, test::TrackerEmulator& device, Capture& capture, std::vector<Frame>& frames) {
  std::mt19937 dice(3);
  Bytes pending;
  Nanoseconds now = 5'000'000'000;
  capture.begin(decoder, 2);
  decoder.expect_up_to(2);
  for (int cycle = 0; cycle < 120; ++cycle) {
    device.tick();
    for (const auto& output : device.drain()) pending.insert(pending.end(), output.bytes.begin(), output.bytes.end());
    if (cycle % 17 == 0) pending.insert(pending.end(), {'0', 'L', 'Y', 0x83, 'V'});
    now += 4 * kMillisecond;
    const std::size_t size = dice() % (pending.size() + 1);
    const Bytes chunk(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(size));
    pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(size));
    if (cycle % 29 == 28) {
      capture.lost();
      decoder.lost_bytes();
    }
    capture.bytes(chunk, now);
    for (Frame& frame : decoder.feed(chunk, now).frames) frames.push_back(std::move(frame));
  }
}

void expect_same_again(const std::string& path, const std::string& kind, const std::vector<Frame>& frames,
                       std::uint64_t bad_bytes) {
  ASSERT_GT(frames.size(), 20u);
  test::WatchedTracker run(
      [&](TimeSource now) { return std::move(*make_tracker("replay:" + path + "@fast", std::move(now))); });
  ASSERT_TRUE(run.wait_for_message("come to its end after " + std::to_string(frames.size()) + " frames"))
      << run.status().message;
  EXPECT_EQ(run.status().state, State::silent);
  EXPECT_EQ(run.status().bad_bytes, bad_bytes);
  run.stop();
  const std::vector<Frame> again = run.frames();
  ASSERT_EQ(again.size(), frames.size());
  // A SpaceMouse's own time is that of the arrival.
  const Nanoseconds shift = again[0].t_ns - frames[0].t_ns;
  EXPECT_EQ(test::frames_text(again, shift), test::frames_text(frames, 0));
  EXPECT_EQ(again[0].device, kind);
}

TEST_F(Replay, GivesALibertysFramesAgain) {
  test::LibertyEmulator device(2);
  device.set_motion([](int station, std::uint32_t count) {
    return test::SourcePose{10.0 + station, 0.01 * count, -3.0, 0.5 * (count % 100), 10.0, 5.0};
  });
  device.write("F1\rU1\rO*,8,9,11,3,7\rC\r");
  LibertyDecoder decoder = std::move(*LibertyDecoder::make({}));
  std::vector<Frame> frames;
  {
    auto capture = Capture::create(path);
    ASSERT_TRUE(capture);
    capture_dirty_line(decoder, device, **capture, frames);
  }
  expect_same_again(path, "liberty", frames, decoder.bad_bytes());
}

TEST_F(Replay, GivesAFastraksFramesAgain) {
  test::FastrakEmulator device(2);
  device.write("uO1,2,11,16,0\rO2,2,11,16,0\rfC");
  FastrakDecoder decoder = std::move(*FastrakDecoder::make({}));
  std::vector<Frame> frames;
  {
    auto capture = Capture::create(path);
    ASSERT_TRUE(capture);
    capture_dirty_line(decoder, device, **capture, frames);
  }
  expect_same_again(path, "fastrak", frames, decoder.bad_bytes());
}

TEST_F(Replay, GivesAnIsotraksFramesAgain) {
  test::FastrakEmulator device(2, test::FastrakEmulator::Kind::isotrak);
  device.write("uO2,11\rfC");
  IsotrakDecoder decoder({});
  std::vector<Frame> frames;
  {
    auto capture = Capture::create(path);
    ASSERT_TRUE(capture);
    capture_dirty_line(decoder, device, **capture, frames);
  }
  expect_same_again(path, "isotrak", frames, decoder.bad_bytes());
}

TEST_F(Replay, GivesAVipersFramesAgain) {
  test::ViperEmulator device(2);
  device.set_units(3, 2);
  device.start();
  ViperDecoder decoder({});
  std::vector<Frame> frames;
  {
    auto capture = Capture::create(path);
    ASSERT_TRUE(capture);
    capture_dirty_line(decoder, device, **capture, frames);
  }
  expect_same_again(path, "viper", frames, decoder.bad_bytes());
}

TEST_F(Replay, KeepsItsOwnPaceAndCanBeStopped) {
  write("posed.capture/1\ndecoder isotrak isotrak 2\nexpect 1\n1000000000 00\n1050000000 00\n9000000000000 00\n");
  Clock clock;
  std::atomic<int> statuses{0};
  auto tracker = make_tracker("replay:" + path, [&clock] { return clock.now(); });
  ASSERT_TRUE(tracker) << tracker.error().message;
  EXPECT_EQ((*tracker)->id(), "isotrak");
  EXPECT_EQ((*tracker)->kind(), "replay");
  (*tracker)->start({{}, [&](const Status&) { ++statuses; }});
  while (clock.now() < 50 * kMillisecond) std::this_thread::yield();
  (*tracker)->stop();  // two and a half hours early
  EXPECT_GE(statuses, 1);
}

TEST_F(Replay, AFileThatIsNoneIsRefused) {
  EXPECT_EQ(make_tracker("replay:", [] { return Nanoseconds{0}; }).error().code, "invalid_params");
  EXPECT_EQ(make_tracker("replay:" + path, [] { return Nanoseconds{0}; }).error().code, "not_available");
  EXPECT_EQ(make_tracker("replay:" + testing::TempDir(), [] { return Nanoseconds{0}; }).error().code, "not_available");
  for (const char* text : {"", "hello\n", "posed.capture/2\n", "posed.capture/1\n", "posed.capture/1\nlost\n",
                           "posed.capture/1\ndecoder mouse mouse 2\n", "posed.capture/1\ndecoder liberty liberty\n",
                           "posed.capture/1\ndecoder isotrak ../isotrak 2\n"}) {
    write(text);
    const auto made = make_tracker("replay:" + path, [] { return Nanoseconds{0}; });
    ASSERT_FALSE(made) << text;
    EXPECT_EQ(made.error().code, "invalid_params") << text;
    EXPECT_NE(made.error().hint, "");
  }
}

TEST_F(Replay, ABrokenLineIsNamed) {
  for (const char* line : {"1000 0g\n", "1000 000\n", "abc 00\n", "expect many\n", "decoder x\n"}) {
    write(std::string("posed.capture/1\ndecoder isotrak isotrak 2\n") + line);
    test::WatchedTracker run(
        [&](TimeSource now) { return std::move(*make_tracker("replay:" + path, std::move(now))); });
    ASSERT_TRUE(run.wait_for_state(State::failed)) << line;
    EXPECT_NE(run.status().message.find("line 3"), std::string::npos) << run.status().message;
  }
}

// As a program leaves it that was killed.
TEST_F(Replay, ALineWithoutAnEndIsNone) {
  write("posed.capture/1\ndecoder isotrak isotrak 2\n1000 00\n1001 0");
  test::WatchedTracker run(
      [&](TimeSource now) { return std::move(*make_tracker("replay:" + path + "@fast", std::move(now))); });
  ASSERT_TRUE(run.wait_for_message("come to its end"));
}

TEST_F(Replay, ACaptureOverwritesNothing) {
  write("precious\n");
  const auto capture = Capture::create(path);
  ASSERT_FALSE(capture);
  EXPECT_NE(capture.error().message.find("is there already"), std::string::npos);
  EXPECT_FALSE(Capture::create("/nowhere/at/all.capture"));
}

TEST(Decoders, EachIsMadeAnewFromItsDescription) {
  FastrakFormat ascii;
  ascii.binary = false;
  ascii.items = {52, 61, 1};
  ascii.metres_per_unit = kMetresPerInch;
  LibertyFormat patriot;
  patriot.device = "patriot";
  patriot.tag = {'P', 'A'};
  patriot.stations = 2;
  patriot.rate_hz = 60;
  const std::unique_ptr<Decoder> all[] = {std::make_unique<LibertyDecoder>(std::move(*LibertyDecoder::make(patriot))),
                                          std::make_unique<FastrakDecoder>(std::move(*FastrakDecoder::make({}))),
                                          std::make_unique<FastrakDecoder>(std::move(*FastrakDecoder::make(ascii))),
                                          std::make_unique<IsotrakDecoder>(IsotrakFormat{}),
                                          std::make_unique<ViperDecoder>(ViperFormat{}),
                                          std::make_unique<SpacemouseDecoder>(SpacemouseFormat{})};
  for (const auto& decoder : all) {
    const auto made = make_decoder(decoder->description());
    ASSERT_TRUE(made) << decoder->description();
    EXPECT_EQ(made->decoder->description(), decoder->description());
  }
}

}  // namespace
}  // namespace posed::tracker
