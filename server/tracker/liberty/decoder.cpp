#include "server/tracker/liberty/decoder.h"

#include <utility>

#include "server/tracker/liberty/header.h"

namespace posed::tracker {

Result<LibertyDecoder> LibertyDecoder::make(LibertyFormat format) {
  auto layout = LibertyLayout::make(format.items);
  if (!layout) return layout.error();
  return LibertyDecoder(std::move(format), std::move(*layout));
}

LibertyDecoder::LibertyDecoder(LibertyFormat format, LibertyLayout layout)
    : format_(std::move(format)),
      layout_(std::move(layout)),
      assembler_(format_.device, layout_.counted()),
      clock_(format_.rate_hz) {}

Heard LibertyDecoder::feed(std::span<const std::uint8_t> bytes, Nanoseconds now) {
  Heard out;
  buffer_.feed(bytes, [&](std::span<const std::uint8_t> rest, bool in_step) -> std::size_t {
    Sample sample;
    const Kind kind = examine(rest, in_step, sample);
    if (kind == Kind::partial) return RecordBuffer::kPartial;
    if (kind == Kind::nothing) return 0;
    const LibertyHeader header = parse_liberty_header(rest);
    const std::span<const std::uint8_t> body = rest.subspan(kLibertyHeaderSize, static_cast<std::size_t>(header.size));
    if (kind == Kind::data) {
      take(sample, header.error, now, out);
    } else {
      out.replies.push_back(
          {header.station, header.command, no_error(header.error) ? 0 : header.error, {body.begin(), body.end()}});
    }
    return kLibertyHeaderSize + body.size();
  });
  return out;
}

std::string LibertyDecoder::description() const {
  std::string items;
  for (const int item : format_.items) items += (items.empty() ? "" : ",") + std::to_string(item);
  return "liberty " + format_.device + " " + std::string(format_.tag.data(), format_.tag.size()) + " " +
         std::to_string(format_.stations) + " " + items + " " +
         (format_.metres_per_unit == kMetresPerInch ? "in" : "cm") + " " + std::to_string(format_.rate_hz);
}

LibertyDecoder::Kind LibertyDecoder::examine(std::span<const std::uint8_t> bytes, bool in_step, Sample& sample) const {
  const auto tagged = [&](std::size_t at) {
    for (std::size_t i = 0; i < format_.tag.size() && at + i < bytes.size(); ++i) {
      if (bytes[at + i] != static_cast<std::uint8_t>(format_.tag[i])) return false;
    }
    return true;
  };
  if (!tagged(0)) return Kind::nothing;
  if (bytes.size() < kLibertyHeaderSize) return Kind::partial;

  const LibertyHeader header = parse_liberty_header(bytes);
  const bool data = is_data(header, format_.stations, layout_.body_size());
  const bool complaint = !data && is_complaint(header, format_.stations);
  if (!data && !complaint && !is_answer(header, format_.stations)) return Kind::nothing;

  const std::size_t end = kLibertyHeaderSize + static_cast<std::size_t>(header.size);
  if (bytes.size() < end) return Kind::partial;
  const std::span<const std::uint8_t> body = bytes.subspan(kLibertyHeaderSize, end - kLibertyHeaderSize);
  if (complaint) return printable(body) ? Kind::reply : Kind::nothing;
  if (!data) return Kind::reply;

  sample.station = header.station;
  if (!layout_.decode(body, format_.metres_per_unit, sample)) return Kind::nothing;
  // There is no checksum, and tag bytes occur inside floats. Out of step, a record counts only once the next tag stands
  // behind it; in step it is believed at once, so that a healthy stream waits for nothing.
  if (in_step) return Kind::data;
  if (!tagged(end)) return Kind::nothing;
  return bytes.size() < end + format_.tag.size() ? Kind::partial : Kind::data;
}

void LibertyDecoder::take(Sample sample, std::uint8_t error, Nanoseconds now, Heard& out) {
  if (!no_error(error)) {
    sample.flags |= kFlagError;
    sample.error_letter = static_cast<char>(error);
  }
  // The count, not the device's own millisecond stamp, which is rounded down and jitters by a quarter of the period.
  if (layout_.counted()) sample.device_t_ns = clock_.at(sample.device_count);
  assembler_.add(sample, now, out.frames);
}

}  // namespace posed::tracker
