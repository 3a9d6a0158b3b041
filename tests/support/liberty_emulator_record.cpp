// The records of LibertyEmulator: what one measurement cycle says, in binary and in ASCII.
#include "tests/support/emulator_pack.h"
#include "tests/support/liberty_emulator.h"

namespace posed::test {
namespace {

struct Values {
  LibertyPose pose;  // in the units that are set
  double q[4];       // scalar first
  double m[9];       // rows: the sensor's axes, in columns, in the source frame
  std::uint32_t count, milliseconds;
  int distortion;
  bool button;
};

void put_item(Bytes& to, int item, const Values& v) {
  const LibertyPose& p = v.pose;
  switch (item) {
    case 0:
      put_text(to, " ");
      break;
    case 1:
      put_text(to, "\r\n");
      break;
    case 2:
    case 3:
      for (const double value : {p.x, p.y, p.z}) put_f32(to, value);
      break;
    case 4:
    case 5:
      for (const double value : {p.azimuth, p.elevation, p.roll}) put_f32(to, value);
      break;
    case 6:
      for (const double value : v.m) put_f32(to, value);
      break;
    case 7:
      for (const double value : v.q) put_f32(to, value);
      break;
    case 8:
      put_u32(to, v.milliseconds);
      break;
    case 9:
      put_u32(to, v.count);
      break;
    case 10:
      put_u32(to, v.button ? 1 : 0);
      break;
    case 11:
      put_u32(to, static_cast<std::uint32_t>(v.distortion));
      break;
    default:
      put_u32(to, 0);
      break;  // external sync
  }
}

void put_item_text(Bytes& to, int item, const Values& v) {
  const LibertyPose& p = v.pose;
  switch (item) {
    case 0:
      put_text(to, " ");
      break;
    case 1:
      put_text(to, "\r\n");
      break;
    case 2:
      for (const double value : {p.x, p.y, p.z}) put_text(to, format("%8.3f ", value));
      break;
    case 3:
      for (const double value : {p.x, p.y, p.z}) put_text(to, format("% .6E ", value));
      break;
    case 4:
      for (const double value : {p.azimuth, p.elevation, p.roll}) put_text(to, format("%8.3f ", value));
      break;
    case 5:
      for (const double value : {p.azimuth, p.elevation, p.roll}) put_text(to, format("% .6E ", value));
      break;
    case 6:
      for (int i = 0; i < 9; ++i) put_text(to, format("% .5f ", v.m[i]) + (i % 3 == 2 ? "\r\n" : ""));
      break;
    case 7:
      for (const double value : v.q) put_text(to, format("% .5f ", value));
      break;
    case 8:
      put_text(to, std::to_string(v.milliseconds));
      break;
    case 9:
      put_text(to, std::to_string(v.count));
      break;
    case 10:
      put_text(to, v.button ? "1" : "0");
      break;
    case 11:
      put_text(to, std::to_string(v.distortion));
      break;
    default:
      put_text(to, "0");
      break;
  }
}

}  // namespace

SourcePose LibertyEmulator::raw(int station) {
  const SensorState& sensor = sensors_[station];
  return mirrored(motion_ ? motion_(station, count_) : sensor.pose, sensor.hemisphere.data());
}

SourcePose LibertyEmulator::measured(int station) {
  SourcePose pose = sensors_[station].frames.of(raw(station));
  if (centimetres_) {
    pose.x *= 2.54;
    pose.y *= 2.54;
    pose.z *= 2.54;
  }
  return pose;
}

std::vector<std::uint8_t> LibertyEmulator::record(int station, char command) {
  const SensorState& sensor = sensors_[station];
  Values v{};
  v.pose = measured(station);
  rotation_of(v.pose, v.q);
  matrix_of(v.pose, v.m);
  v.count = count_;
  v.milliseconds = static_cast<std::uint32_t>(std::uint64_t{count_} * 1000 /
                                              static_cast<unsigned>(rate_ == 4 ? kind_.rate_hz : kind_.rate_hz / 2));
  v.distortion = sensor.distortion;
  v.button = sensor.button;
  Bytes body;
  for (const int item : sensor.list) binary_ ? put_item(body, item, v) : put_item_text(body, item, v);
  if (binary_) {
    return framed(station, command, sensor.letter, body);
  }
  // Data records have no command letter: two digits of the station, the error, a blank.
  Bytes line;
  put_text(line, format("%02.0f", station) + (sensor.letter ? sensor.letter : ' ') + " ");
  line.insert(line.end(), body.begin(), body.end());
  return line;
}

std::vector<std::uint8_t> LibertyEmulator::cycle(char command) {
  Bytes bytes;
  for (const auto& [station, sensor] : sensors_) {
    if (!sensor.detected || !sensor.active) continue;
    const Bytes one = record(station, command);
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  return bytes;
}

}  // namespace posed::test
