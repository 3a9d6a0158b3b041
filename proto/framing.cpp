#include "proto/framing.h"

namespace posed::proto {

bool LineSplitter::push(std::string_view bytes) {
  buffer_.erase(0, begin_);
  scanned_ -= begin_;
  begin_ = 0;
  buffer_.append(bytes);
  // The limit is on a line, not on what one read happened to bring.
  const std::size_t last_end = buffer_.rfind('\n');
  const std::size_t tail = last_end == std::string::npos ? buffer_.size() : buffer_.size() - last_end - 1;
  return tail <= max_line_;
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
    if (line.size() > max_line_) continue;
    if (!line.empty()) return line;
  }
}

}  // namespace posed::proto
