#include "server/tracker/liberty_layout.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <string>

namespace posed::tracker {
namespace {

enum Item {
  kSpace = 0,
  kCrLf = 1,
  kPosition = 2,
  kPositionExtended = 3,
  kAngles = 4,
  kAnglesExtended = 5,
  kCosines = 6,
  kQuaternion = 7,
  kTimestamp = 8,
  kFrameCount = 9,
  kStylus = 10,
  kDistortion = 11,
  kExternalSync = 12,
};

constexpr std::size_t kItemSize[] = {1, 2, 12, 12, 12, 12, 36, 16, 4, 4, 4, 4, 4};
constexpr std::size_t kMaxItems = 20;
constexpr double kUnitTolerance = 1e-2;
// The useful range is 1.8 m; an alignment frame may shift the origin some way from the source.
constexpr double kFarthest = 20.0;

std::uint32_t u32_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

double f32_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return std::bit_cast<float>(u32_at(bytes, at));
}

Vec3 vec3_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return {f32_at(bytes, at), f32_at(bytes, at + 4), f32_at(bytes, at + 8)};
}

bool decode_position(const Vec3& source, double metres_per_unit, Sample& sample) {
  sample.position = world_from_source(source * metres_per_unit);
  return finite(sample.position) && std::abs(sample.position.x) < kFarthest &&
         std::abs(sample.position.y) < kFarthest && std::abs(sample.position.z) < kFarthest;
}

bool decode_angles(const Vec3& degrees, Sample& sample) {
  // One degree of slack: the ranges are closed, and rounding may step over their ends.
  if (!finite(degrees) || std::abs(degrees.x) > 181 || std::abs(degrees.y) > 91 || std::abs(degrees.z) > 181) {
    return false;
  }
  const Vec3 radians = degrees * (std::numbers::pi / 180.0);
  sample.rotation = world_from_source(quat_from_angles(radians.x, radians.y, radians.z));
  return true;
}

bool decode_quaternion(std::span<const std::uint8_t> bytes, std::size_t at, Sample& sample) {
  const Quat q(f32_at(bytes, at), f32_at(bytes, at + 4), f32_at(bytes, at + 8), f32_at(bytes, at + 12));
  if (!finite(q)) return false;
  const double length = glm::length(q);
  if (!(std::abs(length - 1.0) <= kUnitTolerance)) return false;
  sample.rotation = world_from_source(q / length);
  return true;
}

Error bad_list(std::string message) {
  return {"out_of_range", std::move(message), "", "a list for posed is 8,9,11,3,7"};
}

}  // namespace

Result<LibertyLayout> LibertyLayout::make(std::span<const int> items) {
  LibertyLayout layout;
  bool position = false, rotation = false;
  if (items.size() > kMaxItems) return bad_list("an output list holds at most 20 items");
  for (const int item : items) {
    if (item < 0 || item >= static_cast<int>(std::size(kItemSize))) {
      return bad_list("the output list holds the unknown item " + std::to_string(item));
    }
    layout.items_.push_back(item);
    layout.body_size_ += kItemSize[item];
    position |= item == kPosition || item == kPositionExtended;
    // The order of the cosines (6) is not said in the manual, so they are stepped over.
    rotation |= item == kAngles || item == kAnglesExtended || item == kQuaternion;
    layout.counted_ |= item == kFrameCount;
  }
  if (!position) return bad_list("the output list holds no position");
  if (!rotation) return bad_list("the output list holds no rotation");
  return layout;
}

bool LibertyLayout::decode(std::span<const std::uint8_t> body, double metres_per_unit, Sample& sample) const {
  std::size_t at = 0;
  bool good = body.size() == body_size_;
  for (std::size_t i = 0; good && i < items_.size(); at += kItemSize[items_[i]], ++i) {
    switch (items_[i]) {
      case kSpace:
        good = body[at] == ' ';
        break;
      case kCrLf:
        good = body[at] == '\r' && body[at + 1] == '\n';
        break;
      case kPosition:
      case kPositionExtended:
        good = decode_position(vec3_at(body, at), metres_per_unit, sample);
        break;
      case kAngles:
      case kAnglesExtended:
        good = decode_angles(vec3_at(body, at), sample);
        break;
      case kQuaternion:
        good = decode_quaternion(body, at, sample);
        break;
      case kTimestamp:
        sample.device_t_ns = Nanoseconds{u32_at(body, at)} * 1'000'000;
        break;
      case kFrameCount:
        sample.device_count = u32_at(body, at);
        break;
      case kStylus:
        good = u32_at(body, at) <= 1;
        sample.buttons = u32_at(body, at);
        break;
      case kDistortion:
        good = u32_at(body, at) <= 2;
        if (u32_at(body, at) != 0) sample.flags |= kFlagDistorted;
        break;
      default:
        break;
    }
  }
  return good;
}

Quat quat_from_angles(double azimuth, double elevation, double roll) {
  return quat_about(kZ, azimuth) * quat_about(kY, elevation) * quat_about(kX, roll);
}

}  // namespace posed::tracker
