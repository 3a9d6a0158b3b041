#include "server/tracker/fastrak/decoder.h"

#include <gtest/gtest.h>

#include "server/tracker/fastrak/reply.h"
#include "server/tracker/fastrak/session.h"
#include "tests/server/tracker/golden_pose.h"
#include "tests/support/fastrak_emulator.h"
#include "tests/support/golden_bytes.h"

namespace posed::tracker {
namespace {

using test::Bytes;
using test::expect_golden_pose;
using test::FastrakEmulator;

Bytes golden(const std::string& name) {
  return test::golden_bytes(POSED_GOLDEN "/fastrak", name);
}

FastrakDecoder decoder(std::vector<int> items = {2, 11, 16, 0}, bool binary = true,
                       double metres_per_unit = kMetresPerCentimetre) {
  FastrakFormat format;
  format.items = std::move(items);
  format.binary = binary;
  format.metres_per_unit = metres_per_unit;
  return std::move(*FastrakDecoder::make(std::move(format)));
}

TEST(FastrakDecoder, ReadsTheFactoryList) {
  FastrakDecoder d = decoder({2, 4, 1}, false, kMetresPerInch);
  const Bytes bytes = golden("factory_list");
  ASSERT_EQ(bytes.size(), 47u);
  const Heard out = d.feed(bytes, 77);
  ASSERT_EQ(out.frames.size(), 1u);
  EXPECT_EQ(out.frames[0].t_ns, 77);
  EXPECT_EQ(out.frames[0].device, "fastrak");
  expect_golden_pose(out.frames[0].samples[0], 1e-6);
  EXPECT_EQ(d.bad_bytes(), 0u);
}

TEST(FastrakDecoder, ReadsTheListThatIsDriven) {
  FastrakDecoder d = decoder();
  const Heard out = d.feed(golden("posed_list"), 1);
  ASSERT_EQ(out.frames.size(), 1u);
  expect_golden_pose(out.frames[0].samples[0], 1e-7);
  EXPECT_EQ(out.frames[0].samples[0].buttons, 0u);
  EXPECT_EQ(out.frames[0].samples[0].flags, 0u);
}

TEST(FastrakDecoder, ReadsExtendedPrecisionAndALetter) {
  FastrakDecoder d = decoder({52, 61, 1}, false, kMetresPerInch);
  const Heard out = d.feed(golden("extended_ascii"), 1);
  ASSERT_EQ(out.frames.size(), 1u);
  const Sample& sample = out.frames[0].samples[0];
  expect_golden_pose(sample, 1e-5);
  EXPECT_EQ(sample.station, 2);
  EXPECT_EQ(sample.flags, kFlagError);
  EXPECT_EQ(sample.error_letter, 'j');
}

TEST(FastrakDecoder, ColumnsMayTouch) {
  FastrakDecoder d = decoder({2, 4, 1}, false, kMetresPerCentimetre);
  const Heard out = d.feed(golden("touching_columns"), 1);
  ASSERT_EQ(out.frames.size(), 1u);
  EXPECT_NEAR(out.frames[0].samples[0].position.x, 0.3001, 1e-9);
  EXPECT_NEAR(out.frames[0].samples[0].position.y, 1.5070, 1e-9);
}

TEST(FastrakDecoder, TellsAnswersAndComplaints) {
  FastrakDecoder d = decoder();
  Bytes bytes = golden("active_stations");
  const Bytes complaint = golden("undefined_command");
  bytes.insert(bytes.end(), complaint.begin(), complaint.end());
  const Heard out = d.feed(bytes, 1);
  ASSERT_EQ(out.replies.size(), 2u);
  EXPECT_EQ(fastrak_stations(out.replies[0]), 5u);
  EXPECT_EQ(out.replies[0].error, 0);
  EXPECT_EQ(out.replies[1].error, -99);
  EXPECT_EQ(fastrak_stations(out.replies[1]), std::nullopt);
  EXPECT_NE(complaint_text(-99).find("does not know (error -99)"), std::string::npos);
  EXPECT_EQ(d.bad_bytes(), 0u);
}

TEST(FastrakDecoder, AReceiverWithoutASignalIsAbsent) {
  FastrakEmulator device(2);
  device.write("uO1,2,11,16,0\rO2,2,11,16,0\rfC");
  FastrakDecoder d = decoder();
  d.expect_up_to(2);
  std::vector<Frame> frames;
  for (int i = 0; i < 20; ++i) {
    if (i == 10) device.unplug_sensor(2);
    device.tick();
    for (Frame& frame : d.feed(device.take(), i).frames) frames.push_back(std::move(frame));
  }
  EXPECT_EQ(frames.front().samples.size(), 2u);
  EXPECT_EQ(frames.back().samples.size(), 1u);
  EXPECT_EQ(d.bad_bytes(), 0u);
}

TEST(FastrakDecoder, TheStylusButton) {
  FastrakEmulator device(1);
  device.write("uO1,2,11,16,0\re1,0\rfC");
  device.press_button(true);
  device.tick();
  FastrakDecoder d = decoder();
  const Heard out = d.feed(device.take(), 1);
  ASSERT_EQ(out.frames.size(), 1u);
  EXPECT_EQ(out.frames[0].samples[0].buttons, 1u);
}

TEST(FastrakDecoder, CutAnywhereTheSameComesOut) {
  FastrakEmulator device(3);
  device.write("uO1,2,11,16,0\rO2,2,11,16,0\rO3,2,11,16,0\rfC");
  Bytes stream;
  for (int i = 0; i < 9; ++i) {
    device.tick();
    if (i == 4) device.write("l1\r");
    const Bytes one = device.take();
    stream.insert(stream.end(), one.begin(), one.end());
    if (i == 6) stream.insert(stream.end(), {'0', '9', 0x81, '2', 0});
  }
  const auto told = [](const Heard& a, const Heard& b, const Decoder& d) {
    std::string text;
    for (const Heard* heard : {&a, &b}) {
      for (const Frame& frame : heard->frames) {
        for (const Sample& sample : frame.samples) text += std::to_string(sample.station);
        text += " ";
      }
    }
    return text + std::to_string(a.replies.size() + b.replies.size()) + " " + std::to_string(d.bad_bytes());
  };
  FastrakDecoder whole = decoder();
  const Heard all = whole.feed(stream, 1);
  EXPECT_EQ(whole.bad_bytes(), 5u);
  EXPECT_EQ(all.replies.size(), 1u);
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    FastrakDecoder d = decoder();
    const Heard first = d.feed(std::span(stream).first(cut), 1);
    const Heard second = d.feed(std::span(stream).subspan(cut), 2);
    EXPECT_EQ(told(first, second, d), told(all, {}, whole)) << cut;
  }
}

// Found by fuzzing: out of step, a record was believed or not by how much of a broken reply behind it had come.
TEST(FastrakDecoder, ABrokenReplyFarBehindMakesNoDifference) {
  Bytes stream{0x81};
  const Bytes record = golden("posed_list"), complaint = golden("undefined_command");
  stream.insert(stream.end(), record.begin(), record.end());
  stream.insert(stream.end(), complaint.begin(), complaint.end() - 2);
  stream.push_back(0x84);
  FastrakDecoder whole = decoder();
  const std::size_t frames = whole.feed(stream, 1).frames.size();
  EXPECT_EQ(frames, 1u);
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    FastrakDecoder d = decoder();
    const std::size_t first = d.feed(std::span(stream).first(cut), 1).frames.size();
    EXPECT_EQ(first + d.feed(std::span(stream).subspan(cut), 2).frames.size(), frames) << cut;
    EXPECT_EQ(d.bad_bytes(), whole.bad_bytes()) << cut;
  }
}

TEST(FastrakDecoder, NoRecordIsMadeOfBrokenOnes) {
  const Bytes good = golden("posed_list");
  for (std::size_t at = 0; at < good.size(); ++at) {
    if (at >= 3 && at < 3 + 12 + 16) continue;  // a number may change; nothing checks it but its range
    for (int value = 0; value < 256; ++value) {
      Bytes bytes = good;
      if (bytes[at] == value) continue;
      const bool station = at == 1 && value >= '1' && value <= '4';
      const bool letter = at == 2 && (std::isalpha(value) || value == ' ');
      const bool button = at == 32 && (value == '0' || value == '1');
      bytes[at] = static_cast<std::uint8_t>(value);
      FastrakDecoder d = decoder();
      const Heard out = d.feed(bytes, 1);
      const bool unplugged = letter && value == 'l';
      EXPECT_EQ(out.frames.size(), (station || letter || button) && !unplugged ? 1u : 0u) << at << " " << value;
    }
  }
}

TEST(FastrakDecoder, ListsThatSayNoPoseAreRefused) {
  for (const std::vector<int>& items : {std::vector<int>{2}, {11, 0}, {2, 11, 42}, {2, 5, 6, 7}}) {
    FastrakFormat format;
    format.items = items;
    const auto made = FastrakDecoder::make(std::move(format));
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, "out_of_range");
  }
}

}  // namespace
}  // namespace posed::tracker
