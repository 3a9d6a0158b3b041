// The records of FastrakEmulator: what a station says in its turn, in binary and in ASCII.
#include <algorithm>
#include <cmath>

#include "tests/support/fastrak_emulator.h"

namespace posed::test {
namespace {

// An ISOTRAK's 16 bits: the whole of them is 65.48 inches.
constexpr double kInchesPerStep = 65.48 / 32767.0;

void put_i16(Bytes& to, double v) {
  put_u16(to, static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(std::clamp(v, -32767.0, 32767.0)))));
}

}  // namespace

SourcePose FastrakEmulator::raw(const Sensor& sensor, int station) const {
  return mirrored(motion_ ? motion_(station, count_) : sensor.pose, sensor.hemisphere.data());
}

Bytes FastrakEmulator::record(int station) {
  const Sensor& sensor = sensors_[station];
  SourcePose pose = sensor.frames.of(raw(sensor, station));
  const char letter = sensor.detected ? sensor.letter : 'l';
  if (kind_ == Kind::isotrak && binary_ && sensor.list == std::vector<int>{2, 11}) return packed(station, pose, letter);
  if (centimetres_) {
    pose.x *= 2.54;
    pose.y *= 2.54;
    pose.z *= 2.54;
  }
  Bytes record{'0', static_cast<std::uint8_t>('0' + station), static_cast<std::uint8_t>(letter)};
  for (const int item : sensor.list) put_item(record, item, pose, station == 1 && button_);
  return record;
}

void FastrakEmulator::put_numbers(Bytes& to, bool extended, const char* pattern,
                                  std::span<const double> numbers) const {
  for (const double v : numbers) {
    if (binary_) {
      put_f32(to, v);
    } else {
      put_text(to, extended ? format("% .5E ", v) : format(pattern, v));
    }
  }
}

void FastrakEmulator::put_item(Bytes& to, int item, const SourcePose& pose, bool button) const {
  const bool extended = item >= 50;
  const double xyz[] = {pose.x, pose.y, pose.z}, angles[] = {pose.azimuth, pose.elevation, pose.roll};
  double q[4], m[9];
  rotation_of(pose, q);
  matrix_of(pose, m);
  switch (item % 50) {
    case 0:
      put_text(to, " ");
      break;
    case 1:
      put_text(to, "\r\n");
      break;
    case 2:
      put_numbers(to, extended, "%7.2f", xyz);
      break;
    case 4:
      put_numbers(to, extended, "%7.2f", angles);
      break;
    case 5:
    case 6:
    case 7:
      put_numbers(to, extended, "%7.4f", std::span(m).subspan(static_cast<std::size_t>(3 * (item % 50 - 5)), 3));
      break;
    case 11:
      put_numbers(to, extended, "%7.4f", q);
      break;
    case 16:
      put_text(to, button ? " 1" : " 0");
      break;
    default:
      break;
  }
}

// Seventeen bytes in twenty of seven bits: the eighth bits of each group of up to seven follow it.
Bytes FastrakEmulator::packed(int station, const SourcePose& pose, char letter) const {
  Bytes plain{'0', static_cast<std::uint8_t>('0' + station), static_cast<std::uint8_t>(letter)};
  if (station == 1 && button_) plain[2] = '@';
  for (const double v : {pose.x, pose.y, pose.z}) put_i16(plain, v / kInchesPerStep);
  double q[4];
  rotation_of(pose, q);
  for (const double v : q) put_i16(plain, v * 32767.0);
  Bytes record;
  for (std::size_t at = 0; at < plain.size(); at += 7) {
    std::uint8_t high = 0;
    const std::size_t size = std::min<std::size_t>(7, plain.size() - at);
    for (std::size_t i = 0; i < size; ++i) {
      record.push_back(plain[at + i] & 0x7f);
      high = static_cast<std::uint8_t>(high | (plain[at + i] >> 7) << i);
    }
    record.push_back(high);
  }
  record[0] |= 0x80;
  return record;
}

}  // namespace posed::test
