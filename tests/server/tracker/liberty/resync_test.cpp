// The decoder on streams that are cut, dirty or broken.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "server/tracker/liberty/decoder.h"
#include "tests/support/emulator_pack.h"
#include "tests/support/liberty_emulator.h"

namespace posed::tracker {
namespace {

using test::Bytes;
using test::LibertyEmulator;

constexpr std::size_t kRecord = 48;
constexpr std::size_t kQuaternionAt = 32;  // in a record of the list 8,9,11,3,7

Bytes stream(int stations, int cycles) {
  LibertyEmulator device(stations);
  device.set_motion([](int station, std::uint32_t count) {
    return test::LibertyPose{10.0 + station, 0.01 * count, -3.0, 0.5 * (count % 100), 10.0, 5.0};
  });
  device.write("F1\rU1\rO*,8,9,11,3,7\rC\r");
  Bytes all;
  for (int i = 0; i < cycles; ++i) {
    device.tick();
    for (const Bytes& bytes : device.take()) all.insert(all.end(), bytes.begin(), bytes.end());
  }
  return all;
}

LibertyDecoder decoder(int stations) {
  LibertyDecoder d = std::move(*LibertyDecoder::make({}));
  d.expect_up_to(stations);
  return d;
}

void append(Bytes& to, const Bytes& bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

std::string text(const std::vector<Frame>& frames) {
  std::string all;
  for (const Frame& frame : frames) {
    for (const Sample& s : frame.samples) {
      char line[160];
      std::snprintf(line, sizeof line, "%d:%u(%.9g %.9g %.9g)(%.9g %.9g)%u;", s.station, s.device_count, s.position.x,
                    s.position.y, s.position.z, s.rotation.w, s.rotation.x, s.flags);
      all += line;
    }
    all += "\n";
  }
  return all;
}

std::string decoded_in_two(const Bytes& bytes, std::size_t cut, int stations, std::uint64_t* bad = nullptr) {
  LibertyDecoder d = decoder(stations);
  Heard first = d.feed(std::span(bytes).first(cut), 1);
  Heard second = d.feed(std::span(bytes).subspan(cut), 2);
  for (Frame& frame : second.frames) first.frames.push_back(std::move(frame));
  if (bad) *bad = d.bad_bytes();
  return text(first.frames);
}

void set_f32(Bytes& bytes, std::size_t at, float v) {
  std::memcpy(&bytes[at], &v, sizeof v);
}

TEST(LibertyResync, EveryCutGivesTheSame) {
  const Bytes clean = stream(2, 3);
  Bytes dirty{'x', 'L', 'Y', 1};
  append(dirty, stream(2, 3));
  dirty[60] ^= 0x40;
  append(dirty, {'L', 'Y', 2, 'C', 0, 0, 40, 0, 'L'});
  append(dirty, stream(2, 3));
  for (const Bytes& bytes : {clean, dirty}) {
    std::uint64_t whole_bad = 0, bad = 0;
    const std::string whole = decoded_in_two(bytes, 0, 2, &whole_bad);
    for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
      EXPECT_EQ(decoded_in_two(bytes, cut, 2, &bad), whole) << "cut at " << cut;
      EXPECT_EQ(bad, whole_bad) << "cut at " << cut;
    }
  }
}

TEST(LibertyResync, ByteByByte) {
  const Bytes bytes = stream(3, 4);
  LibertyDecoder d = decoder(3);
  std::vector<Frame> frames;
  for (const std::uint8_t byte : bytes) {
    for (Frame& frame : d.feed({&byte, 1}, 1).frames) frames.push_back(std::move(frame));
  }
  EXPECT_EQ(text(frames), decoded_in_two(bytes, 0, 3));
  EXPECT_EQ(frames.size(), 4u);
  EXPECT_EQ(d.bad_bytes(), 0u);
}

TEST(LibertyResync, AFrameIsStampedWithTheArrivalOfItsLastByte) {
  const Bytes bytes = stream(2, 1);
  LibertyDecoder d = decoder(2);
  EXPECT_TRUE(d.feed(std::span(bytes).first(60), 100).frames.empty());
  const Heard out = d.feed(std::span(bytes).subspan(60), 200);
  ASSERT_EQ(out.frames.size(), 1u);
  EXPECT_EQ(out.frames[0].t_ns, 200);
}

TEST(LibertyResync, GarbageBeforeAndBetweenIsCounted) {
  for (std::size_t garbage = 1; garbage < 100; ++garbage) {
    Bytes bytes(garbage, 'L');
    append(bytes, stream(1, 2));
    append(bytes, Bytes(garbage, 0xff));
    append(bytes, stream(1, 3));
    LibertyDecoder d = decoder(1);
    const Heard out = d.feed(bytes, 1);
    // Out of step a record is believed only with a tag behind it, so the second before the next garbage still is.
    EXPECT_EQ(out.frames.size(), 5u) << garbage;
    EXPECT_EQ(d.bad_bytes(), 2 * garbage);
  }
}

TEST(LibertyResync, TagsInsideFloatsAreNoTags) {
  // A record whose position and quaternion spell headers, from which the start is cut off.
  Bytes whole = stream(1, 4);
  for (std::size_t record = 0; record < 4; ++record) {
    const std::uint8_t header[] = {'L', 'Y', 1, 'C', 0, 0, 40, 0};
    std::memcpy(&whole[record * kRecord + 20], header, sizeof header);
    set_f32(whole, record * kRecord + 20, 12.0f);
    std::memcpy(&whole[record * kRecord + 24], header, sizeof header);
  }
  for (std::size_t start = 1; start < kRecord; ++start) {
    LibertyDecoder d = decoder(1);
    const Heard out = d.feed(std::span(whole).subspan(start), 1);
    for (const Frame& frame : out.frames) EXPECT_NEAR(frame.samples[0].position.x, 0.12, 1e-6) << start;
    EXPECT_GE(out.frames.size(), 2u) << start;
    EXPECT_EQ(d.bad_bytes(), kRecord - start);
  }
}

TEST(LibertyResync, AHeaderOutOfTheBlueCostsNoRecord) {
  Bytes bytes{'L', 'Y', 1, 'C', 0, 0, 40, 0};
  append(bytes, stream(1, 3));
  LibertyDecoder d = decoder(1);
  EXPECT_EQ(d.feed(bytes, 1).frames.size(), 3u);
  EXPECT_EQ(d.bad_bytes(), 8u);
}

TEST(LibertyResync, WhatNoDeviceSendsIsRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const auto bad_after = [](const std::function<void(Bytes&)>& spoil) {
    Bytes bytes = stream(1, 3);
    spoil(bytes);
    LibertyDecoder d = decoder(1);
    const Heard out = d.feed(bytes, 1);
    EXPECT_EQ(out.frames.size(), 2u);
    for (const Frame& frame : out.frames) EXPECT_TRUE(finite(frame.samples[0].position));
    return d.bad_bytes();
  };
  EXPECT_EQ(bad_after([&](Bytes& b) { set_f32(b, 20, nan); }), kRecord);
  EXPECT_EQ(bad_after([&](Bytes& b) { set_f32(b, 24, -inf); }), kRecord);
  EXPECT_EQ(bad_after([&](Bytes& b) { set_f32(b, 28, 1e30f); }), kRecord);
  EXPECT_EQ(bad_after([&](Bytes& b) { set_f32(b, kQuaternionAt, nan); }), kRecord);
  EXPECT_EQ(bad_after([&](Bytes& b) { set_f32(b, kQuaternionAt, 2.0f); }), kRecord);
  EXPECT_EQ(bad_after([&](Bytes& b) { b[16] = 3; }), kRecord);    // distortion level
  EXPECT_EQ(bad_after([&](Bytes& b) { b[2] = 17; }), kRecord);    // station
  EXPECT_EQ(bad_after([&](Bytes& b) { b[2] = 0; }), kRecord);     // station
  EXPECT_EQ(bad_after([&](Bytes& b) { b[3] = 'D'; }), kRecord);   // command
  EXPECT_EQ(bad_after([&](Bytes& b) { b[4] = 0x80; }), kRecord);  // error
  EXPECT_EQ(bad_after([&](Bytes& b) { b[6] = 41; }), kRecord);    // size
  EXPECT_EQ(bad_after([&](Bytes& b) { b[7] = 0xff; }), kRecord);  // a size below zero
}

TEST(LibertyResync, QuaternionsALittleOffAreNormalised) {
  Bytes bytes = stream(1, 1);
  for (std::size_t i = 0; i < 4; ++i) {
    float v = 0;
    std::memcpy(&v, &bytes[kQuaternionAt + 4 * i], sizeof v);
    set_f32(bytes, kQuaternionAt + 4 * i, v * 1.009f);
  }
  const Heard out = decoder(1).feed(bytes, 1);
  ASSERT_EQ(out.frames.size(), 1u);
  EXPECT_NEAR(glm::length(out.frames[0].samples[0].rotation), 1.0, 1e-12);
}

TEST(LibertyResync, OneFlippedBitCostsLittleAndNeverForges) {
  const Bytes clean = stream(2, 6);
  for (std::size_t bit = 0; bit < 8 * clean.size(); ++bit) {
    Bytes bytes = clean;
    bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
    LibertyDecoder d = decoder(2);
    const Heard out = d.feed(bytes, 1);
    EXPECT_GE(out.frames.size(), 4u) << "bit " << bit;
    EXPECT_LE(d.bad_bytes(), 2 * kRecord) << "bit " << bit;
    for (const Frame& frame : out.frames) {
      for (const Sample& sample : frame.samples) {
        EXPECT_TRUE(finite(sample.position)) << "bit " << bit;
        EXPECT_NEAR(glm::length(sample.rotation), 1.0, 1e-9) << "bit " << bit;
      }
    }
  }
}

TEST(LibertyResync, ALossInTheLineIsPassedOver) {
  const Bytes clean = stream(1, 6);
  for (std::size_t lost = 1; lost < kRecord; ++lost) {
    Bytes bytes = clean;
    bytes.erase(bytes.begin() + 70, bytes.begin() + 70 + static_cast<std::ptrdiff_t>(lost));
    LibertyDecoder d = decoder(1);
    const Heard out = d.feed(bytes, 1);
    EXPECT_GE(out.frames.size(), 3u) << lost;
    for (const Frame& frame : out.frames) EXPECT_NEAR(frame.samples[0].position.x, 11 * 0.0254, 1e-6) << lost;
  }
}

TEST(LibertyResync, AfterATellOfLossTheHalfRecordIsDropped) {
  const Bytes bytes = stream(1, 3);
  LibertyDecoder d = decoder(1);
  EXPECT_TRUE(d.feed(std::span(bytes).first(20), 1).frames.empty());
  d.lost_bytes();
  EXPECT_EQ(d.feed(std::span(bytes).subspan(kRecord), 2).frames.size(), 2u);
  EXPECT_EQ(d.bad_bytes(), 20u);
}

TEST(LibertyResync, NoiseYieldsNothing) {
  std::mt19937 random(1);
  LibertyDecoder d = decoder(4);
  Bytes noise(4096);
  std::size_t frames = 0;
  for (int i = 0; i < 256; ++i) {
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
    frames += d.feed(noise, 1).frames.size();
  }
  EXPECT_EQ(frames, 0u);
  EXPECT_NEAR(static_cast<double>(d.bad_bytes()), 4096.0 * 256, 300.0);
}

}  // namespace
}  // namespace posed::tracker
