// What the CRC must keep out, tried exhaustively.
#include "server/tracker/viper/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/golden_bytes.h"
#include "tests/support/viper_emulator.h"

namespace posed::tracker {
namespace {

using test::Bytes;

Bytes bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

bool accepted(const Bytes& bytes) {
  const ViperFrame frame = examine_viper_frame(bytes);
  return frame.whole;
}

// Bits in the order in which they go over the line: the lowest of each byte first.
void flip(Bytes& bytes, std::size_t bit) {
  bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << (bit % 8)));
}

// One sensor: 60 bytes.
Bytes pose_frame(std::uint32_t count) {
  test::ViperEmulator device(1);
  device.set_units(3, 2);
  device.start();
  for (std::uint32_t i = 1; i < count; ++i) {
    device.tick();
    device.take();
  }
  device.tick();
  return device.take();
}

TEST(ViperFrame, TheChecksumIsTheStandardOne) {
  const std::string_view check = "123456789";
  EXPECT_EQ(crc16(std::span(reinterpret_cast<const std::uint8_t*>(check.data()), check.size())), 0xBB3D);
}

TEST(ViperFrame, CommandsAreAsTheSdkSendsThem) {
  const Bytes start{0x56, 0x50, 0x52, 0x43, 0x18, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 0x13, 0,    0, 0,
                    0,    0,    0,    0,    0,    0, 0, 0, 0,    0,    0,    0,    0x36, 0x0d, 0, 0};
  EXPECT_EQ(bytes_of(viper_command(kViperContinuous, ViperAction::set)), start);
  Bytes stop = start;
  stop[16] = 2;
  stop[28] = 0xcf;
  stop[29] = 0xca;
  EXPECT_EQ(bytes_of(viper_command(kViperContinuous, ViperAction::reset)), stop);
  const std::uint32_t units[] = {3, 2};
  EXPECT_TRUE(accepted(bytes_of(viper_command(kViperUnits, ViperAction::set, units))));
}

TEST(ViperFrame, EveryOneAndTwoFlippedBitsAreSeen) {
  const Bytes good = pose_frame(3);
  ASSERT_EQ(good.size(), 60u);
  ASSERT_TRUE(accepted(good));
  Bytes bytes = good;
  for (std::size_t a = 0; a < 8 * good.size(); ++a) {
    flip(bytes, a);
    ASSERT_FALSE(accepted(bytes)) << a;
    for (std::size_t b = a + 1; b < 8 * good.size(); ++b) {
      flip(bytes, b);
      ASSERT_FALSE(accepted(bytes)) << a << " " << b;
      flip(bytes, b);
    }
    flip(bytes, a);
  }
  EXPECT_EQ(bytes, good);
}

// Every pattern of up to 16 bits, at every bit.
TEST(ViperFrame, EveryBurstOfSixteenBitsIsSeen) {
  const Bytes good = bytes_of(viper_command(kViperContinuous, ViperAction::set));
  ASSERT_TRUE(accepted(good));
  const std::size_t bits = 8 * good.size();
  for (std::size_t at = 0; at < bits; ++at) {
    for (std::uint32_t pattern = 1; pattern < 1u << 16; pattern += 2) {
      Bytes bytes = good;
      const std::uint32_t shifted = pattern << (at % 8);
      for (std::size_t i = 0; i < 3 && at / 8 + i < bytes.size(); ++i) {
        bytes[at / 8 + i] = static_cast<std::uint8_t>(bytes[at / 8 + i] ^ (shifted >> (8 * i) & 0xff));
      }
      ASSERT_FALSE(accepted(bytes)) << at << " " << pattern;
    }
  }
}

TEST(ViperFrame, WhatIsCutOffIsWaitedForAndNotTaken) {
  const Bytes good = pose_frame(3);
  for (std::size_t size = 1; size < good.size(); ++size) {
    const Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
    const ViperFrame frame = examine_viper_frame(cut);
    EXPECT_FALSE(frame.whole) << size;
    EXPECT_GT(frame.size, size < 8 ? 0 : size) << size;
  }
}

// The beginning of one frame and the end of another, and one with a piece missing or said twice.
TEST(ViperFrame, SplicesAreSeen) {
  const Bytes one = pose_frame(3), other = pose_frame(9);
  std::size_t different = 0;
  while (one[different] == other[different]) ++different;
  for (std::size_t at = different + 1; at < one.size(); ++at) {
    Bytes spliced(one.begin(), one.begin() + static_cast<std::ptrdiff_t>(at));
    spliced.insert(spliced.end(), other.begin() + static_cast<std::ptrdiff_t>(at), other.end());
    EXPECT_EQ(accepted(spliced), spliced == one) << at;
  }
  for (std::size_t from = 8; from < one.size(); ++from) {
    for (std::size_t size = 1; from + size < one.size(); ++size) {
      Bytes shorter = one, longer = one;
      const auto begin = static_cast<std::ptrdiff_t>(from), end = static_cast<std::ptrdiff_t>(from + size);
      shorter.erase(shorter.begin() + begin, shorter.begin() + end);
      shorter.insert(shorter.end(), other.begin(), other.end());
      EXPECT_FALSE(accepted(shorter)) << from << " " << size;
      longer.insert(longer.begin() + end, one.begin() + begin, one.begin() + end);
      EXPECT_EQ(accepted(longer), std::equal(one.begin(), one.end(), longer.begin())) << from << " " << size;
    }
  }
}

TEST(ViperFrame, SizesThatNoFrameHasAreNone) {
  const Bytes good = pose_frame(1);
  for (std::uint32_t size : {0u, 23u, 51u, 53u, 20u + 32u * 17u, 0xffffffffu, 0xfffffff8u}) {
    Bytes bytes = good;
    for (int i = 0; i < 4; ++i) bytes[4 + i] = static_cast<std::uint8_t>(size >> (8 * i));
    EXPECT_EQ(examine_viper_frame(bytes).size, 0u) << size;
  }
}

}  // namespace
}  // namespace posed::tracker
