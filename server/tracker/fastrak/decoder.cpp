#include "server/tracker/fastrak/decoder.h"

#include <algorithm>
#include <utility>

#include "server/tracker/error_letter.h"
#include "server/tracker/fastrak/reply.h"

namespace posed::tracker {
namespace {

constexpr std::size_t kHeader = 3;

}  // namespace

Result<FastrakDecoder> FastrakDecoder::make(FastrakFormat format) {
  auto layout = FastrakLayout::make(format.items, format.binary);
  if (!layout) return layout.error();
  return FastrakDecoder(std::move(format), std::move(*layout));
}

FastrakDecoder::FastrakDecoder(FastrakFormat format, FastrakLayout layout)
    : format_(std::move(format)), layout_(std::move(layout)), assembler_(format_.device, false) {}

Heard FastrakDecoder::feed(std::span<const std::uint8_t> bytes, Nanoseconds now) {
  Heard out;
  buffer_.feed(bytes, [&](std::span<const std::uint8_t> rest, bool in_step) -> std::size_t {
    if (rest[0] == '0') return examine_data(rest, in_step, now, out);
    TextReply text = examine_text_reply(rest, format_.stations);
    if (text.state == TextReply::State::partial) return RecordBuffer::kPartial;
    if (text.state == TextReply::State::whole) out.replies.push_back(std::move(text.reply));
    return text.size;
  });
  return out;
}

std::size_t FastrakDecoder::examine_data(std::span<const std::uint8_t> bytes, bool in_step, Nanoseconds now,
                                         Heard& out) {
  if (!begins_record(bytes)) return 0;
  const std::size_t end = kHeader + layout_.body_size();
  if (bytes.size() < end) return RecordBuffer::kPartial;
  Sample sample;
  sample.station = bytes[1] - '0';
  if (!layout_.decode(bytes.subspan(kHeader, layout_.body_size()), format_.metres_per_unit, sample)) return 0;
  // There is no checksum. Out of step, a record counts only once another stands behind it; in step it is believed at
  // once, so that a healthy stream waits for nothing.
  if (!in_step) {
    if (!begins_record(bytes.subspan(end))) return 0;
    if (bytes.size() < end + kHeader) return RecordBuffer::kPartial;
  }
  if (bytes[2] != ' ') {
    sample.flags |= kFlagError;
    sample.error_letter = static_cast<char>(bytes[2]);
  }
  if (sample.error_letter != kNoSignal) assembler_.add(sample, now, out.frames);
  return end;
}

bool FastrakDecoder::begins_record(std::span<const std::uint8_t> bytes) const {
  // No further than the header: what a reply turns out to be later must not matter to the record before it.
  bytes = bytes.first(std::min(bytes.size(), kHeader));
  if (!bytes.empty() && bytes[0] != '0') {
    return examine_text_reply(bytes, format_.stations).state != TextReply::State::none;
  }
  if (bytes.size() > 1 && !(bytes[1] >= '1' && bytes[1] <= '0' + format_.stations)) return false;
  return bytes.size() <= 2 || bytes[2] == ' ' || is_letter(bytes[2]);
}

std::string FastrakDecoder::description() const {
  std::string items;
  for (const int item : format_.items) items += (items.empty() ? "" : ",") + std::to_string(item);
  return "fastrak " + format_.device + " " + std::to_string(format_.stations) + " " + items + " " +
         (format_.binary ? "binary" : "ascii") + " " + (format_.metres_per_unit == kMetresPerInch ? "in" : "cm");
}

}  // namespace posed::tracker
