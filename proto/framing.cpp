#include "proto/framing.h"

namespace posed::proto {

bool LineSplitter::push(std::string_view bytes) {
  if (too_long_) return false;
  buffer_.erase(0, begin_);
  scanned_ -= begin_;
  begin_ = 0;
  // Only the first line of what is buffered can be unfinished from before; the others lie within `bytes`.
  for (std::string_view left = bytes; !left.empty();) {
    const std::size_t end = left.find('\n');
    const std::string_view part = left.substr(0, end);
    pending_ += part.size();
    // A "\r" before the line's end is not the line's; where a piece ends behind it, the next byte tells.
    const bool may_end = part.empty() || part.back() == '\r';
    if (pending_ > max_line_ + (may_end ? 1 : 0)) {
      buffer_.append(bytes.substr(0, bytes.size() - left.size()));
      too_long_ = true;
      return false;
    }
    if (end == std::string_view::npos) break;
    pending_ = 0;
    left.remove_prefix(end + 1);
  }
  buffer_.append(bytes);
  return true;
}

std::optional<std::string_view> LineSplitter::next() {
  for (;;) {
    const std::size_t end = buffer_.find('\n', scanned_);
    if (end == std::string::npos) {
      scanned_ = buffer_.size();
      return std::nullopt;
    }
    std::string_view line = std::string_view(buffer_).substr(begin_, end - begin_);
    begin_ = scanned_ = end + 1;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (!line.empty()) return line;
  }
}

}  // namespace posed::proto
