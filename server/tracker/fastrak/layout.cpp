#include "server/tracker/fastrak/layout.h"

#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "server/tracker/little_endian.h"

namespace posed::tracker {
namespace {

enum Id {
  kSpace = 0,
  kCrLf = 1,
  kPosition = 2,
  kAngles = 4,
  kCosinesX = 5,
  kCosinesZ = 7,
  kQuaternion = 11,
  kStylus = 16
};

constexpr std::size_t kMaxItems = 32;
// In ASCII a quaternion has four decimals.
constexpr double kUnitTolerance = 1e-2;

int count_of(int id) {
  return id == kQuaternion ? 4 : 3;
}

// Columns touch: " 30.01-150.70" is two numbers.
bool parse_column(std::string_view text, double& value) {
  const std::size_t begin = text.find_first_not_of(' ');
  const std::size_t end = text.find_last_not_of(' ');
  if (begin == std::string_view::npos) return false;
  text = text.substr(begin, end + 1 - begin);
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && rest == text.data() + text.size();
}

Error bad_list(std::string message) {
  return {"out_of_range", std::move(message), "", "a list for posed is 2,11,16,0"};
}

}  // namespace

Result<FastrakLayout> FastrakLayout::make(std::span<const int> items, bool binary) {
  FastrakLayout layout;
  layout.binary_ = binary;
  bool position = false, rotation = false;
  if (items.size() > kMaxItems) return bad_list("an output list holds at most 32 items");
  for (const int item : items) {
    const bool extended = item >= 50;
    const int id = extended ? item - 50 : item;
    const std::size_t column = extended ? 13 : 7;
    std::size_t size = 0;
    switch (id) {
      case kSpace:
        size = 1;
        break;
      case kCrLf:
      case kStylus:  // a blank and a digit, in binary too
        size = 2;
        break;
      case kPosition:
      case kAngles:
      case kCosinesX:
      case kCosinesX + 1:
      case kCosinesZ:
      case kQuaternion:
        size = static_cast<std::size_t>(count_of(id)) * (binary ? 4 : column);
        break;
      default:
        return bad_list("the output list holds the unknown item " + std::to_string(item));
    }
    layout.items_.push_back({id, size, column});
    layout.body_size_ += size;
    position |= id == kPosition;
    // The cosines are stepped over: sources differ on whether they are rows or columns.
    rotation |= id == kAngles || id == kQuaternion;
  }
  if (!position) return bad_list("the output list holds no position");
  if (!rotation) return bad_list("the output list holds no rotation");
  return layout;
}

bool FastrakLayout::numbers(std::span<const std::uint8_t> body, const Item& item, std::span<double> into) const {
  for (std::size_t i = 0; i < into.size(); ++i) {
    if (binary_) {
      into[i] = f32_at(body, 4 * i);
      continue;
    }
    std::array<char, 16> column{};
    for (std::size_t c = 0; c < item.column; ++c) column[c] = static_cast<char>(body[i * item.column + c]);
    if (!parse_column({column.data(), item.column}, into[i])) return false;
  }
  return true;
}

bool FastrakLayout::decode(std::span<const std::uint8_t> body, double metres_per_unit, Sample& sample) const {
  bool good = body.size() == body_size_;
  std::size_t at = 0;
  for (std::size_t i = 0; good && i < items_.size(); at += items_[i].size, ++i) {
    const Item& item = items_[i];
    const std::span<const std::uint8_t> part = body.subspan(at, item.size);
    std::array<double, 4> v{};
    switch (item.id) {
      case kSpace:
        good = part[0] == ' ';
        break;
      case kCrLf:
        good = part[0] == '\r' && part[1] == '\n';
        break;
      case kPosition:
        good = numbers(part, item, std::span(v).first(3)) &&
               take_position(Vec3(v[0], v[1], v[2]) * metres_per_unit, sample);
        break;
      case kAngles:
        good = numbers(part, item, std::span(v).first(3)) && take_angles({v[0], v[1], v[2]}, sample);
        break;
      case kQuaternion:
        good = numbers(part, item, v) && take_quaternion(Quat(v[0], v[1], v[2], v[3]), sample, kUnitTolerance);
        break;
      case kStylus:
        good = part[0] == ' ' && (part[1] == '0' || part[1] == '1');
        sample.buttons = part[1] == '1' ? 1 : 0;
        break;
      default:
        break;
    }
  }
  return good;
}

}  // namespace posed::tracker
