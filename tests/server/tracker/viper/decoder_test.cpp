#include "server/tracker/viper/decoder.h"

#include <gtest/gtest.h>

#include "server/tracker/viper/frame.h"
#include "tests/server/tracker/golden_pose.h"
#include "tests/support/golden_bytes.h"
#include "tests/support/viper_emulator.h"

namespace posed::tracker {
namespace {

using test::Bytes;
using test::expect_golden_pose;
using test::ViperEmulator;

Bytes golden(const std::string& name) {
  return test::golden_bytes(POSED_GOLDEN "/viper", name);
}

TEST(ViperDecoder, ReadsAPoseFrame) {
  ViperDecoder d({});
  const Heard out = d.feed(golden("two_sensors"), 77);
  ASSERT_EQ(out.frames.size(), 1u);
  const Frame& frame = out.frames[0];
  EXPECT_EQ(frame.t_ns, 77);
  EXPECT_EQ(frame.device, "viper");
  ASSERT_EQ(frame.samples.size(), 2u);
  EXPECT_EQ(frame.samples[0].station, 1);
  EXPECT_EQ(frame.samples[1].station, 3);
  for (const Sample& sample : frame.samples) expect_golden_pose(sample, 1e-7);
  EXPECT_EQ(frame.samples[0].buttons, 0u);
  EXPECT_EQ(frame.samples[1].buttons, 1u);
  EXPECT_EQ(frame.samples[0].device_count, 240u);
  EXPECT_EQ(frame.samples[0].device_t_ns, 1'000'000'000);
}

TEST(ViperDecoder, TellsAnswers) {
  ViperDecoder d({});
  const Heard out = d.feed(golden("station_map"), 1);
  ASSERT_EQ(out.replies.size(), 1u);
  EXPECT_EQ(out.replies[0].command, static_cast<std::uint32_t>(kViperStationMap));
  EXPECT_EQ(out.replies[0].error, 0);
  EXPECT_EQ(out.replies[0].body, (Bytes{5, 0, 0, 1}));
}

TEST(ViperDecoder, AllItsUnitsAndModesSayTheSame) {
  for (const int mode : {0, 1}) {
    for (std::uint32_t position = 0; position < 4; ++position) {
      for (std::uint32_t orientation = 0; orientation < 3; ++orientation) {
        ViperEmulator device(1);
        device.set_mode(mode);
        device.set_units(position, orientation);
        device.start();
        device.tick();
        ViperDecoder d({});
        const Heard out = d.feed(device.take(), 1);
        ASSERT_EQ(out.frames.size(), 1u) << mode << position << orientation;
        expect_golden_pose(out.frames[0].samples[0], mode == 1 ? 5e-5 : 1e-6);
      }
    }
  }
}

TEST(ViperDecoder, ARefusalIsAnError) {
  ViperEmulator device(1);
  device.set_refusing(7);
  const std::uint32_t units[] = {3, 2};
  device.write(viper_command(kViperUnits, ViperAction::set, units));
  ViperDecoder d({});
  const Heard out = d.feed(device.take(), 1);
  ASSERT_EQ(out.replies.size(), 1u);
  EXPECT_NE(out.replies[0].error, 0);
}

// A frame that is broken anywhere is skipped, and the next one is found; nothing is made up of what is left.
TEST(ViperDecoder, ABrokenFrameCostsItselfAlone) {
  const Bytes good = golden("two_sensors");
  for (std::size_t at = 0; at < good.size(); ++at) {
    Bytes bytes = good;
    bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ 0x10);
    bytes.insert(bytes.end(), good.begin(), good.end());
    // A size that has grown makes it wait for more than there is.
    const Bytes zeros(3000, 0);
    bytes.insert(bytes.end(), zeros.begin(), zeros.end());
    ViperDecoder d({});
    const Heard out = d.feed(bytes, 1);
    EXPECT_EQ(out.frames.size(), 1u) << at;
    EXPECT_EQ(d.bad_bytes(), good.size() + zeros.size()) << at;
  }
}

TEST(ViperDecoder, CutAnywhereTheSameComesOut) {
  Bytes stream = golden("two_sensors");
  const Bytes map = golden("station_map");
  stream.insert(stream.end(), {'V', 'P', 'R'});
  stream.insert(stream.end(), map.begin(), map.end());
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    ViperDecoder d({});
    const Heard first = d.feed(std::span(stream).first(cut), 1);
    const Heard second = d.feed(std::span(stream).subspan(cut), 2);
    EXPECT_EQ(first.frames.size() + second.frames.size(), 1u) << cut;
    EXPECT_EQ(first.replies.size() + second.replies.size(), 1u) << cut;
    EXPECT_EQ(d.bad_bytes(), 3u) << cut;
  }
}

}  // namespace
}  // namespace posed::tracker
