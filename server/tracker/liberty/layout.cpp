#include "server/tracker/liberty/layout.h"

#include <string>

#include "server/tracker/little_endian.h"

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
        good = take_position(vec3_at(body, at) * metres_per_unit, sample);
        break;
      case kAngles:
      case kAnglesExtended:
        good = take_angles(vec3_at(body, at), sample);
        break;
      case kQuaternion:
        good = take_quaternion(quat_at(body, at), sample);
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

}  // namespace posed::tracker
