#include "server/tracker/isotrak/decoder.h"

#include <gtest/gtest.h>

#include "server/tracker/fastrak/session.h"
#include "tests/server/tracker/golden_pose.h"
#include "tests/support/fastrak_emulator.h"
#include "tests/support/golden_bytes.h"

namespace posed::tracker {
namespace {

using test::Bytes;
using test::FastrakEmulator;

Bytes golden(const std::string& name) {
  return test::golden_bytes(POSED_GOLDEN "/isotrak", name);
}

TEST(IsotrakDecoder, ReadsTheListThatIsDriven) {
  IsotrakDecoder d({});
  const Heard out = d.feed(golden("posed_list"), 77);
  ASSERT_EQ(out.frames.size(), 1u);
  EXPECT_EQ(out.frames[0].device, "isotrak");
  EXPECT_EQ(out.frames[0].t_ns, 77);
  const Sample& sample = out.frames[0].samples[0];
  EXPECT_EQ(sample.station, 1);
  test::expect_golden_pose(sample, 3e-5);
  EXPECT_EQ(d.bad_bytes(), 0u);
}

TEST(IsotrakDecoder, TellsWhoIsSwitchedOn) {
  IsotrakDecoder d({});
  const Heard out = d.feed(golden("active_stations"), 1);
  ASSERT_EQ(out.replies.size(), 1u);
  EXPECT_EQ(fastrak_stations(out.replies[0]), 1u);
}

TEST(IsotrakDecoder, TheButtonStandsWhereTheErrorWould) {
  FastrakEmulator device(1, FastrakEmulator::Kind::isotrak);
  device.write("O2,11\re1,0\rfC");
  device.press_button(true);
  device.tick();
  IsotrakDecoder d({});
  const Heard out = d.feed(device.take(), 1);
  ASSERT_EQ(out.frames.size(), 1u);
  EXPECT_EQ(out.frames[0].samples[0].buttons, 1u);
  EXPECT_EQ(out.frames[0].samples[0].flags, 0u);
}

TEST(IsotrakDecoder, ARecordThatIsCutShortCostsItselfAlone) {
  const Bytes good = golden("posed_list");
  for (std::size_t cut = 0; cut < good.size(); ++cut) {
    Bytes bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(cut));
    bytes.insert(bytes.end(), good.begin(), good.end());
    IsotrakDecoder d({});
    EXPECT_EQ(d.feed(bytes, 1).frames.size(), 1u) << cut;
    EXPECT_EQ(d.bad_bytes(), cut);
  }
}

TEST(IsotrakDecoder, CutAnywhereTheSameComesOut) {
  Bytes stream = golden("posed_list");
  const Bytes reply = golden("active_stations");
  stream.insert(stream.end(), reply.begin(), reply.end());
  stream.insert(stream.end(), {0x90, 0x12, 'x'});
  const Bytes again = golden("posed_list");
  stream.insert(stream.end(), again.begin(), again.end());
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    IsotrakDecoder d({});
    const Heard first = d.feed(std::span(stream).first(cut), 1);
    const Heard second = d.feed(std::span(stream).subspan(cut), 2);
    EXPECT_EQ(first.frames.size() + second.frames.size(), 2u) << cut;
    EXPECT_EQ(first.replies.size() + second.replies.size(), 1u) << cut;
    EXPECT_EQ(d.bad_bytes(), 3u) << cut;
  }
}

}  // namespace
}  // namespace posed::tracker
