#include "server/tracker/spacemouse/decoder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/tracker/little_endian.h"

namespace posed::tracker {
namespace {

enum ReportId { kMotion = 1, kRotation = 2, kButtons = 3 };

constexpr std::size_t kHalf = 7, kWhole = 13;  // the id, and three or six 16-bit numbers
constexpr double kFull = 350.0;
constexpr double kMetresPerSecond = 0.4, kRadiansPerSecond = 1.5;  // where the cap is pushed as far as it goes
// Reports come every 8 or 16 ms while the cap is pushed, and none while it rests.
constexpr Nanoseconds kUsual = 8'000'000, kLongest = 50'000'000;
constexpr Vec3 kHome{0.45, -0.25, 1.20};
constexpr double kFarthest = 3.0;  // m from the origin, so that it cannot be lost
constexpr std::uint32_t kFirstTwo = 3;

// Who sits before it looks forward: its right is -Y, towards the user is -X, and down is -Z.
Vec3 world_from_cap(const Vec3& v) {
  return {-v.y, -v.x, -v.z};
}

Vec3 numbers_at(std::span<const std::uint8_t> report, std::size_t at) {
  const auto number = [&](std::size_t i) { return std::clamp(i16_at(report, at + 2 * i) / kFull, -1.0, 1.0); };
  return {number(0), number(1), number(2)};
}

double seconds_since(Nanoseconds& last, Nanoseconds now) {
  const Nanoseconds passed = now - std::exchange(last, now);
  return static_cast<double>(passed > 0 && passed < kLongest ? passed : kUsual) * 1e-9;
}

}  // namespace

Heard SpacemouseDecoder::feed(std::span<const std::uint8_t> report, Nanoseconds now) {
  Heard out;
  if (report.empty()) return out;
  const int id = report[0];
  if (id == kMotion && (report.size() == kHalf || report.size() == kWhole)) {
    push(numbers_at(report, 1), now);
    if (report.size() == kWhole) turn(numbers_at(report, 7), now);
  } else if (id == kRotation && report.size() == kHalf) {
    turn(numbers_at(report, 1), now);
  } else if (id == kButtons && report.size() >= 2 && report.size() <= kHalf) {
    sample_.buttons = 0;
    for (std::size_t i = 1; i < std::min<std::size_t>(report.size(), 5); ++i) {
      sample_.buttons |= static_cast<std::uint32_t>(report[i]) << (8 * (i - 1));
    }
    if ((sample_.buttons & kFirstTwo) == kFirstTwo) home();
  } else {
    // The battery and the like are no error; what has no id of theirs is.
    if (id <= kButtons) bad_bytes_ += report.size();
    return out;
  }
  out.frames.push_back({now, 0, format_.device, {sample_}});
  return out;
}

void SpacemouseDecoder::push(const Vec3& cap, Nanoseconds now) {
  const double seconds = seconds_since(pushed_ns_, now);
  sample_.position += world_from_cap(cap) * (kMetresPerSecond * seconds);
  for (int axis = 0; axis < 3; ++axis)
    sample_.position[axis] = std::clamp(sample_.position[axis], -kFarthest, kFarthest);
}

void SpacemouseDecoder::turn(const Vec3& cap, Nanoseconds now) {
  const double seconds = seconds_since(turned_ns_, now);
  const Vec3 rate = world_from_cap(cap) * kRadiansPerSecond;
  const double speed = glm::length(rate);
  if (speed == 0.0) return;
  sample_.rotation = glm::normalize(quat_about(rate / speed, speed * seconds) * sample_.rotation);
}

void SpacemouseDecoder::home() {
  const Sample fresh = at_home();
  sample_.position = fresh.position;
  sample_.rotation = same_sign(sample_.rotation, fresh.rotation);
}

Sample SpacemouseDecoder::at_home() {
  Sample sample;
  sample.position = kHome;
  return sample;
}

std::string SpacemouseDecoder::description() const {
  return "spacemouse " + format_.device;
}

}  // namespace posed::tracker
