#include "server/tracker/liberty_decoder.h"

#include <utility>

#include "server/tracker/liberty_header.h"

namespace posed::tracker {

Result<LibertyDecoder> LibertyDecoder::make(LibertyFormat format) {
  auto layout = LibertyLayout::make(format.items);
  if (!layout) return layout.error();
  return LibertyDecoder(std::move(format), std::move(*layout));
}

LibertyDecoder::LibertyDecoder(LibertyFormat format, LibertyLayout layout)
    : format_(std::move(format)), layout_(std::move(layout)), assembler_(format_.device, layout_.counted()) {}

LibertyOutput LibertyDecoder::feed(std::span<const std::uint8_t> bytes, Nanoseconds now) {
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  LibertyOutput out;
  std::size_t at = 0;
  while (at < buffer_.size()) {
    const std::span<const std::uint8_t> rest = std::span(buffer_).subspan(at);
    Sample sample;
    const Kind kind = examine(rest, sample);
    if (kind == Kind::partial) break;
    if (kind == Kind::nothing) {
      // One byte at a time: the true start may lie inside what looked like a record.
      ++at;
      ++bad_bytes_;
      in_step_ = false;
      continue;
    }
    const LibertyHeader header = parse_liberty_header(rest);
    const std::span<const std::uint8_t> body = rest.subspan(kLibertyHeaderSize, static_cast<std::size_t>(header.size));
    if (kind == Kind::data) {
      take(sample, header.error, now, out);
    } else {
      const std::uint8_t error = no_error(header.error) ? std::uint8_t{0} : header.error;
      out.replies.push_back({header.station, header.command, error, {body.begin(), body.end()}});
    }
    at += kLibertyHeaderSize + body.size();
    in_step_ = true;
  }
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(at));
  return out;
}

void LibertyDecoder::lost_bytes() {
  bad_bytes_ += buffer_.size();
  buffer_.clear();
  in_step_ = false;
}

void LibertyDecoder::restart() {
  buffer_.clear();
  in_step_ = true;
  have_count_ = false;
  assembler_.reset();
}

LibertyDecoder::Kind LibertyDecoder::examine(std::span<const std::uint8_t> bytes, Sample& sample) const {
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
  if (in_step_) return Kind::data;
  if (!tagged(end)) return Kind::nothing;
  return bytes.size() < end + format_.tag.size() ? Kind::partial : Kind::data;
}

void LibertyDecoder::take(Sample sample, std::uint8_t error, Nanoseconds now, LibertyOutput& out) {
  if (!no_error(error)) {
    sample.flags |= kFlagError;
    sample.error_letter = static_cast<char>(error);
  }
  if (layout_.counted()) sample.device_t_ns = device_time(sample.device_count);
  assembler_.add(sample, now, out.frames);
}

// The count, not the device's own millisecond stamp, which is rounded down and jitters by a quarter of the period.
Nanoseconds LibertyDecoder::device_time(std::uint32_t count) {
  if (!have_count_) long_count_ = count;
  if (have_count_) long_count_ += static_cast<std::int32_t>(count - last_count_);
  have_count_ = true;
  last_count_ = count;
  const std::int64_t rate = format_.rate_hz, second = 1'000'000'000;
  return long_count_ / rate * second + long_count_ % rate * second / rate;
}

}  // namespace posed::tracker
