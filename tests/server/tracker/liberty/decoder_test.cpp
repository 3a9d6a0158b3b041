#include "server/tracker/liberty/decoder.h"

#include <gtest/gtest.h>

#include <cstring>

#include "server/tracker/liberty/header.h"
#include "tests/support/emulator_pack.h"
#include "tests/support/golden_bytes.h"
#include "tests/support/liberty_emulator.h"

namespace posed::tracker {
namespace {

using test::Bytes;
using test::LibertyEmulator;

Bytes golden(const std::string& name) {
  return test::golden_bytes(POSED_GOLDEN "/liberty", name);
}

LibertyDecoder decoder(LibertyFormat format = {}) {
  return std::move(*LibertyDecoder::make(std::move(format)));
}

LibertyFormat factory() {
  LibertyFormat format;
  format.items = {2, 4, 1};
  format.metres_per_unit = kMetresPerInch;
  return format;
}

LibertyEmulator streaming(int stations) {
  LibertyEmulator device(stations);
  device.write("F1\rU1\rO*,8,9,11,3,7\rC\r");
  return device;
}

Bytes taken(LibertyEmulator& device) {
  Bytes all;
  for (const Bytes& bytes : device.take()) all.insert(all.end(), bytes.begin(), bytes.end());
  return all;
}

Bytes cycles(LibertyEmulator& device, int count) {
  Bytes all;
  for (int i = 0; i < count; ++i) {
    device.tick();
    const Bytes one = taken(device);
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

void expect_near(const Quat& a, const Quat& b, double tolerance) {
  EXPECT_NEAR(a.w, b.w, tolerance);
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// The pose of the golden files in the world's axes: Y and Z turned round.
void expect_golden_pose(const Sample& sample) {
  EXPECT_NEAR(sample.position.x, 0.254, 1e-7);
  EXPECT_NEAR(sample.position.y, 0.0635, 1e-7);
  EXPECT_NEAR(sample.position.z, -0.08255, 1e-7);
  expect_near(sample.rotation, Quat(0.871836437, 0.214679867, 0.188823735, -0.397692569), 1e-7);
}

TEST(LibertyDecoder, ReadsAPatriotAtASerialPort) {
  LibertyFormat format;
  format.device = "patriot";
  format.tag = {'P', 'A'};
  format.stations = 2;
  format.items = {9, 11, 3, 7};
  format.rate_hz = 60;
  LibertyDecoder d = decoder(format);
  const Heard out = d.feed(test::golden_bytes(POSED_GOLDEN "/patriot", "posed_list"), 77);
  ASSERT_EQ(out.frames.size(), 1u);
  EXPECT_EQ(out.frames[0].device, "patriot");
  expect_golden_pose(out.frames[0].samples[0]);
  EXPECT_EQ(out.frames[0].samples[0].device_t_ns, 1'000'000'000);
  LibertyDecoder liberty = decoder();
  EXPECT_TRUE(liberty.feed(test::golden_bytes(POSED_GOLDEN "/patriot", "posed_list"), 77).frames.empty());
}

TEST(LibertyDecoder, ReadsTheFactoryList) {
  LibertyDecoder d = decoder(factory());
  const Heard out = d.feed(golden("factory_list"), 77);
  ASSERT_EQ(out.frames.size(), 1u);
  EXPECT_EQ(out.frames[0].t_ns, 77);
  EXPECT_EQ(out.frames[0].device, "liberty");
  ASSERT_EQ(out.frames[0].samples.size(), 1u);
  expect_golden_pose(out.frames[0].samples[0]);
  EXPECT_EQ(d.bad_bytes(), 0u);
}

TEST(LibertyDecoder, ReadsItsOwnListInCentimetres) {
  LibertyDecoder d = decoder();
  const Heard out = d.feed(golden("posed_list"), 77);
  ASSERT_EQ(out.frames.size(), 1u);
  const Sample& sample = out.frames[0].samples.at(0);
  expect_golden_pose(sample);
  EXPECT_EQ(sample.device_count, 1000u);
  EXPECT_EQ(sample.device_t_ns, 4'166'666'666);  // the count at 240 Hz, finer than the device's own milliseconds
  EXPECT_EQ(sample.flags, 0u);
}

TEST(LibertyDecoder, KeepsWhatCarriesAnErrorLetter) {
  LibertyDecoder d = decoder();
  d.expect_up_to(2);
  const Heard out = d.feed(golden("two_stations"), 1);
  ASSERT_EQ(out.frames.size(), 1u);
  ASSERT_EQ(out.frames[0].samples.size(), 2u);
  const Sample& sample = out.frames[0].samples[1];
  EXPECT_EQ(sample.flags, kFlagError | kFlagDistorted);
  EXPECT_EQ(sample.error_letter, 'u');
  EXPECT_EQ(sample.position, (Vec3{0.3, -0.1, 0.2}));
}

TEST(LibertyDecoder, BlankAsErrorByteIsNone) {
  Bytes bytes = golden("posed_list");
  bytes[4] = ' ';
  LibertyDecoder d = decoder();
  const Heard out = d.feed(bytes, 1);
  ASSERT_EQ(out.frames.size(), 1u);
  EXPECT_EQ(out.frames[0].samples[0].flags, 0u);
}

TEST(LibertyDecoder, TellsAnswersAndComplaintsApart) {
  LibertyDecoder d = decoder();
  Bytes bytes = golden("active_stations");
  const Bytes complaint = golden("invalid_command"), data = golden("posed_list");
  bytes.insert(bytes.end(), complaint.begin(), complaint.end());
  bytes.insert(bytes.end(), data.begin(), data.end());
  const Heard out = d.feed(bytes, 1);
  ASSERT_EQ(out.replies.size(), 2u);
  EXPECT_EQ(out.replies[0].command, kCommandActiveStations);
  EXPECT_EQ(out.replies[0].error, 0);
  EXPECT_EQ(out.replies[0].body, (Bytes{3, 0, 7, 0}));
  EXPECT_EQ(out.replies[1].error, 1);
  EXPECT_EQ(out.frames.size(), 1u);
  EXPECT_EQ(d.bad_bytes(), 0u);
}

TEST(LibertyDecoder, ItsArithmeticAgreesWithTheEmulators) {
  for (const bool centimetres : {false, true}) {
    LibertyEmulator device(1);
    device.set_pose(1, {20, 5, -7, -100, 70, 160});
    device.write(centimetres ? "F1\rU1\rO1,2,7\rP" : "F1\rO1,2,4,0\rP");
    LibertyFormat format;
    format.items = centimetres ? std::vector{2, 7} : std::vector{2, 4, 0};
    format.metres_per_unit = centimetres ? kMetresPerCentimetre : kMetresPerInch;
    LibertyDecoder d = decoder(format);
    const Heard out = d.feed(taken(device), 1);
    ASSERT_EQ(out.frames.size(), 1u);
    EXPECT_NEAR(out.frames[0].samples[0].position.x, 0.508, 1e-6);
    EXPECT_NEAR(out.frames[0].samples[0].position.y, -0.127, 1e-6);
    EXPECT_NEAR(out.frames[0].samples[0].position.z, 0.1778, 1e-6);
    const double to_rad = 3.14159265358979 / 180;
    const Quat expected = world_from_source(quat_from_angles(-100 * to_rad, 70 * to_rad, 160 * to_rad));
    EXPECT_NEAR(std::abs(glm::dot(out.frames[0].samples[0].rotation, expected)), 1.0, 1e-6);
  }
}

TEST(LibertyDecoder, CountsOnWhereTheFrameCountWraps) {
  LibertyEmulator device = streaming(1);
  device.set_count(0xfffffffeu);
  LibertyDecoder d = decoder();
  const Heard out = d.feed(cycles(device, 4), 1);
  ASSERT_EQ(out.frames.size(), 4u);
  for (std::size_t i = 1; i < 4; ++i) {
    const Nanoseconds step = out.frames[i].samples[0].device_t_ns - out.frames[i - 1].samples[0].device_t_ns;
    EXPECT_NEAR(static_cast<double>(step), 1e9 / 240, 1.0);
  }
  EXPECT_EQ(out.frames[3].samples[0].device_count, 2u);
}

TEST(LibertyDecoder, QuaternionsKeepTheirSign) {
  Bytes bytes = golden("posed_list"), turned = golden("posed_list");
  for (std::size_t at = 32; at < 48; at += 4) turned[at + 3] ^= 0x80;
  turned[12]++;  // the frame count
  bytes.insert(bytes.end(), turned.begin(), turned.end());
  LibertyDecoder d = decoder();
  const Heard out = d.feed(bytes, 1);
  ASSERT_EQ(out.frames.size(), 2u);
  expect_near(out.frames[1].samples[0].rotation, out.frames[0].samples[0].rotation, 1e-12);
}

TEST(LibertyDecoder, RefusesListsThatItCannotServe) {
  for (const std::vector<int>& items : {std::vector<int>{}, {2}, {7}, {2, 6}, {2, 7, 13}, {2, 7, -1}}) {
    LibertyFormat format;
    format.items = items;
    EXPECT_FALSE(LibertyDecoder::make(format));
  }
}

}  // namespace
}  // namespace posed::tracker
