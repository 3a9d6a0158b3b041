#include "tests/support/viper_emulator.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

namespace posed::test {
namespace {

constexpr std::uint32_t kUnit = 4711;  // its serial number

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t v = 0;
  std::memcpy(&v, bytes.data() + at, sizeof v);
  return v;
}

void seal(Bytes& frame) {
  put_u32(frame, 0);
  const auto size = static_cast<std::uint32_t>(frame.size() - 8);
  std::memcpy(frame.data() + 4, &size, sizeof size);
  const std::uint32_t crc = slow_crc16(std::span(frame).first(frame.size() - 4));
  std::memcpy(frame.data() + frame.size() - 4, &crc, sizeof crc);
}

}  // namespace

std::uint16_t slow_crc16(std::span<const std::uint8_t> bytes) {
  std::uint16_t crc = 0;
  for (const std::uint8_t byte : bytes) {
    crc = static_cast<std::uint16_t>(crc ^ byte);
    for (int i = 0; i < 8; ++i) {
      const bool odd = crc & 1;
      crc = static_cast<std::uint16_t>(crc >> 1);
      if (odd) crc = static_cast<std::uint16_t>(crc ^ 0xA001);
    }
  }
  return crc;
}

ViperEmulator::ViperEmulator(int stations) {
  for (int station = 1; station <= stations; ++station) plug_sensor(station);
}

void ViperEmulator::write(std::span<const std::uint8_t> bytes) {
  if (deaf_) return;
  heard_.insert(heard_.end(), bytes.begin(), bytes.end());
  while (heard_.size() >= 8) {
    const std::size_t size = std::size_t{8} + word(heard_, 4);
    if (word(heard_, 0) != 0x43525056 || size < 32 || size > 1024) {
      heard_.erase(heard_.begin());
      continue;
    }
    if (heard_.size() < size) return;
    if (slow_crc16(std::span(heard_).first(size - 4)) == word(heard_, size - 4)) {
      execute(std::span(heard_).first(size));
      heard_.erase(heard_.begin(), heard_.begin() + static_cast<std::ptrdiff_t>(size));
    } else {
      heard_.erase(heard_.begin());
    }
  }
}

void ViperEmulator::execute(std::span<const std::uint8_t> frame) {
  enum { kSet, kGet, kReset, kAck, kNak };
  const std::uint32_t command = word(frame, 12), action = word(frame, 16), argument = word(frame, 20);
  const auto refuse = [&](const char* why) {
    Bytes block(180, 0);
    std::memcpy(block.data() + 4, why, std::strlen(why));
    answer(command, kNak, argument, block);
  };
  Bytes payload;
  if (static_cast<int>(command) == refusing_) return refuse("not today");
  if (command == 19 && action == kGet) return refuse("invalid action");
  if (command == 19) {
    continuous_ = action == kSet;
  } else if (command == 7 && action == kSet) {
    if (frame.size() < 40 || word(frame, 28) > 3 || word(frame, 32) > 2) return refuse("invalid units");
    units_ = {word(frame, 28), word(frame, 32)};
  } else if (command == 10 && action == kGet) {
    std::uint32_t map = 1u << 24;
    for (const auto& [station, sensor] : sensors_) map |= sensor.detected ? 1u << (station - 1) : 0u;
    put_u32(payload, map);
  } else if (command == 6 && action == kGet) {
    put_u32(payload, rate_);
  } else if (command == 6 && action == kSet) {
    if (frame.size() != 36 || word(frame, 28) >= std::size(kRates)) return refuse("invalid rate");
    rate_ = word(frame, 28);
  } else if (command == 0 && action == kSet) {
    if (!set_hemisphere(argument, frame.subspan(28, frame.size() - 32))) return refuse("invalid hemisphere");
  } else if (command == 1 && action == kSet) {
    if (!set_filter(word(frame, 24), frame.subspan(28, frame.size() - 32))) return refuse("invalid filter");
  } else {
    return refuse("unknown command");
  }
  answer(command, kAck, argument, payload);
}

bool ViperEmulator::set_hemisphere(std::uint32_t sensor, std::span<const std::uint8_t> payload) {
  const std::size_t words = old_hemispheres_ ? 2 : 1;
  if (payload.size() != 4 * (words + 3)) return false;
  for (auto& [station, state] : sensors_) {
    if (sensor != ~0u && station != static_cast<int>(sensor) + 1) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      float part = 0.0f;
      std::memcpy(&part, payload.data() + 4 * (words + i), sizeof part);
      state.hemisphere[i] = word(payload, 0) & 1 ? 0.0 : part;
    }
  }
  return true;
}

bool ViperEmulator::set_filter(std::uint32_t target, std::span<const std::uint8_t> payload) {
  if (payload.size() != 20 || target > 2 || word(payload, 0) > 8) return false;
  Filter filter;
  filter.level = word(payload, 0);
  std::memcpy(filter.numbers.data(), payload.data() + 4, sizeof filter.numbers);
  for (const int one : {1, 2}) {
    if (target == 0 || static_cast<int>(target) == one) filters_[one] = filter;
  }
  return true;
}

void ViperEmulator::answer(std::uint32_t command, std::uint32_t action, std::uint32_t argument, const Bytes& payload) {
  Bytes frame;
  put_text(frame, "VPRC");
  for (const std::uint32_t v : {0u, kUnit, command, action, argument, 0u}) put_u32(frame, v);
  frame.insert(frame.end(), payload.begin(), payload.end());
  seal(frame);
  output_.push_back({std::move(frame), false});
}

void ViperEmulator::put_sensor(Bytes& to, int station, const SourcePose& pose) const {
  static constexpr double kPerInch[] = {1.0, 1.0 / 12.0, 2.54, 0.0254};
  put_u32(to, static_cast<std::uint32_t>(station - 1) | units_[0] << 8 | units_[1] << 10 |
                  sensors_.at(station).buttons << 12);
  for (const double v : {pose.x, pose.y, pose.z}) put_f32(to, v * kPerInch[units_[0]]);
  double q[4];
  rotation_of(pose, q);
  if (mode_ == 1) {
    for (const double v : q) put_u16(to, static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(v * 32767))));
    for (int i = 0; i < 4; ++i) put_u16(to, 0);  // acceleration
  } else if (units_[1] == 2) {
    for (const double v : q) put_f32(to, v);
  } else {
    const double scale = units_[1] == 1 ? std::numbers::pi / 180.0 : 1.0;
    for (const double v : {pose.azimuth * scale, pose.elevation * scale, pose.roll * scale, 0.0}) put_f32(to, v);
  }
}

Bytes ViperEmulator::pose_frame() {
  Bytes sensors;
  std::uint32_t count = 0;
  for (const auto& [station, sensor] : sensors_) {
    if (!sensor.detected) continue;
    const SourcePose pose = motion_ ? motion_(station, count_) : sensor.pose;
    const bool follows = sensor.hemisphere == std::array<double, 3>{0, 0, 0};
    put_sensor(sensors, station, follows ? pose : mirrored(pose, sensor.hemisphere.data()));
    ++count;
  }
  Bytes frame;
  put_text(frame, "VPRP");
  for (const std::uint32_t v : {0u, kUnit, count_, static_cast<std::uint32_t>(mode_) | self_test_ << 4, count}) {
    put_u32(frame, v);
  }
  frame.insert(frame.end(), sensors.begin(), sensors.end());
  seal(frame);
  return frame;
}

void ViperEmulator::tick() {
  if (frozen_) return;
  const int rate = kRates[rate_];
  if (rate < rate_hz() && ++ticks_ % static_cast<std::uint32_t>(rate_hz() / rate) != 0) return;
  for (int i = 0; i < std::max(1, rate / rate_hz()); ++i) {
    ++count_;
    // What nobody reads is lost after a while.
    if (continuous_ && output_.size() < 40) output_.push_back({pose_frame(), true});
  }
}

std::deque<TrackerEmulator::Output> ViperEmulator::drain() {
  return std::exchange(output_, {});
}

Bytes ViperEmulator::take() {
  Bytes all;
  for (const Output& output : drain()) all.insert(all.end(), output.bytes.begin(), output.bytes.end());
  return all;
}

void ViperEmulator::power_cycle() {
  heard_.clear();
  output_.clear();
  count_ = 0;
  units_ = {0, 0};
  rate_ = 3;
  filters_.clear();
  for (auto& [station, sensor] : sensors_) sensor.hemisphere = {1, 0, 0};
  continuous_ = false;
}

void ViperEmulator::left_streaming() {
  units_ = {0, 0};
  continuous_ = true;
}

}  // namespace posed::test
