#include "server/tracker/isotrak/decoder.h"

#include <algorithm>
#include <array>
#include <utility>

#include "server/tracker/axes.h"
#include "server/tracker/error_letter.h"
#include "server/tracker/fastrak/reply.h"
#include "server/tracker/little_endian.h"

namespace posed::tracker {
namespace {

constexpr std::size_t kPacked = 20, kRecord = 17, kGroup = 7;
constexpr double kMetresPerStep = 1.6632 / 32767.0;
constexpr double kUnit = 32767.0;
constexpr char kButtonDown = '@', kButtonUp = '*';

std::array<std::uint8_t, kRecord> unpack(std::span<const std::uint8_t> packed) {
  std::array<std::uint8_t, kRecord> record{};
  std::size_t from = 0;
  for (std::size_t to = 0; to < kRecord; to += kGroup) {
    const std::size_t size = std::min(kGroup, kRecord - to);
    const std::uint8_t high = packed[from + size];
    for (std::size_t i = 0; i < size; ++i) {
      record[to + i] = static_cast<std::uint8_t>((packed[from + i] & 0x7f) | (high >> i & 1) << 7);
    }
    from += size + 1;
  }
  return record;
}

}  // namespace

IsotrakDecoder::IsotrakDecoder(IsotrakFormat format) : format_(std::move(format)), assembler_(format_.device, false) {}

Heard IsotrakDecoder::feed(std::span<const std::uint8_t> bytes, Nanoseconds now) {
  Heard out;
  buffer_.feed(bytes, [&](std::span<const std::uint8_t> rest, bool) -> std::size_t {
    if (rest[0] & 0x80) return examine_data(rest, now, out);
    TextReply text = examine_text_reply(rest, format_.stations);
    if (text.state == TextReply::State::partial) return RecordBuffer::kPartial;
    if (text.state == TextReply::State::whole) out.replies.push_back(std::move(text.reply));
    return text.size;
  });
  return out;
}

std::size_t IsotrakDecoder::examine_data(std::span<const std::uint8_t> bytes, Nanoseconds now, Heard& out) {
  const std::size_t there = std::min(bytes.size(), kPacked);
  if (std::any_of(bytes.begin() + 1, bytes.begin() + static_cast<std::ptrdiff_t>(there),
                  [](std::uint8_t byte) { return (byte & 0x80) != 0; })) {
    return 0;
  }
  if (there < kPacked) return RecordBuffer::kPartial;
  const auto record = unpack(bytes);
  // The mark of the start stands in the place of the type's own eighth bit.
  if ((record[0] & 0x7f) != '0' || record[1] < '1' || record[1] > '0' + format_.stations) return 0;
  const std::uint8_t letter = record[2];
  if (letter != ' ' && letter != kButtonDown && letter != kButtonUp && !is_letter(letter)) return 0;

  Sample sample;
  sample.station = record[1] - '0';
  const auto number = [&](std::size_t i) { return static_cast<double>(i16_at(record, 3 + 2 * i)); };
  if (!take_position(Vec3(number(0), number(1), number(2)) * kMetresPerStep, sample)) return 0;
  if (!take_quaternion(Quat(number(3), number(4), number(5), number(6)) / kUnit, sample)) return 0;
  if (letter == kButtonDown) sample.buttons = 1;
  if (is_letter(letter)) {
    sample.flags |= kFlagError;
    sample.error_letter = static_cast<char>(letter);
  }
  if (letter != kNoSignal) assembler_.add(sample, now, out.frames);
  return kPacked;
}

std::string IsotrakDecoder::description() const {
  return "isotrak " + format_.device + " " + std::to_string(format_.stations);
}

}  // namespace posed::tracker
