// How often a decoder takes noise for a sample, in formats without a checksum: random bodies behind a header that is
// right, and random bytes alone. The rates are told in the decoders' headers; what is asserted here is that they hold.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "server/tracker/fastrak/decoder.h"
#include "server/tracker/isotrak/decoder.h"
#include "server/tracker/liberty/decoder.h"
#include "tests/support/emulator_pack.h"
#include "tests/support/fastrak_emulator.h"
#include "tests/support/liberty_emulator.h"

namespace posed::tracker {
namespace {

using test::Bytes;

constexpr int kBodies = 300'000;
constexpr int kNoiseMegabytes = 8;

struct Rate {
  double of_bodies = 0.0;     // frames a body
  double of_megabytes = 0.0;  // frames a megabyte of noise
};

// `record`: one that is right, of which all from `body` on is made random. A body is followed by a header that is
// right, so that the decoder does not wait for it.
template <class Make>
Rate measure(const char* name, Make make, const Bytes& record, std::size_t body, bool packed = false) {
  std::mt19937_64 random(2026);
  Rate rate;
  std::uint64_t frames = 0;
  {
    auto decoder = make();
    decoder.expect_up_to(1);
    EXPECT_EQ(decoder.feed(record, 0).frames.size() + decoder.feed(std::span(record).first(body), 0).frames.size(), 1u)
        << name << ": the record itself is right";
  }
  for (int i = 0; i < kBodies; ++i) {
    auto decoder = make();
    decoder.expect_up_to(1);
    Bytes bytes = record;
    for (std::size_t k = body; k < bytes.size(); ++k)
      bytes[k] = static_cast<std::uint8_t>(packed ? random() & 0x7f : random());
    frames += decoder.feed(bytes, 0).frames.size();
    frames += decoder.feed(std::span(record).first(body), 0).frames.size();
  }
  rate.of_bodies = static_cast<double>(frames) / kBodies;
  auto decoder = make();
  decoder.expect_up_to(1);
  frames = 0;
  Bytes noise(1 << 16);
  for (int i = 0; i < kNoiseMegabytes * 16; ++i) {
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
    frames += decoder.feed(noise, 0).frames.size();
  }
  rate.of_megabytes = static_cast<double>(frames) / kNoiseMegabytes;
  std::printf("%s: %.3g of random bodies behind a right header are taken, %.3g frames in a megabyte of noise\n", name,
              rate.of_bodies, rate.of_megabytes);
  return rate;
}

template <class Emulator>
Bytes record_of(Emulator& device, const char* commands) {
  device.write(commands);
  device.take();
  Bytes bytes;
  for (int i = 0; i < 8 && bytes.empty(); ++i) {
    device.tick();
    if constexpr (std::is_same_v<Emulator, test::FastrakEmulator>)
      bytes = device.take();
    else
      for (const auto& part : device.take()) bytes.insert(bytes.end(), part.begin(), part.end());
  }
  return bytes;
}

TEST(FalseFrames, Liberty) {
  test::LibertyEmulator device(1);
  const Bytes record = record_of(device, "F1\rU1\rO*,8,9,11,3,7\rC\r");
  ASSERT_EQ(record.size(), 48u);
  const Rate rate = measure(
      "LIBERTY, list 8,9,11,3,7", [] { return std::move(*LibertyDecoder::make({})); }, record, 8);
  EXPECT_LT(rate.of_bodies, 1e-5);
  EXPECT_LT(rate.of_megabytes, 0.5);
}

TEST(FalseFrames, Fastrak) {
  test::FastrakEmulator device(1);
  const Bytes record = record_of(device, "ufO1,2,11,16,0\rC");
  const Rate rate = measure(
      "FASTRAK, list 2,11,16,0", [] { return std::move(*FastrakDecoder::make({})); }, record, 3);
  EXPECT_LT(rate.of_bodies, 1e-5);
  EXPECT_LT(rate.of_megabytes, 0.5);
}

TEST(FalseFrames, Isotrak) {
  test::FastrakEmulator device(1, test::FastrakEmulator::Kind::isotrak);
  const Bytes record = record_of(device, "ufO2,11\rC");
  ASSERT_EQ(record.size(), 20u);
  const Rate rate = measure(
      "ISOTRAK II, list 2,11", [] { return IsotrakDecoder({}); }, record, 3, true);
  EXPECT_LT(rate.of_bodies, 0.1);
  EXPECT_LT(rate.of_megabytes, 500.0);
}

}  // namespace
}  // namespace posed::tracker
