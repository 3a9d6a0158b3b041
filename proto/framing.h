// Cuts a byte stream into lines, ended by "\n" or "\r\n".
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace posed::proto {

class LineSplitter {
 public:
  explicit LineSplitter(std::size_t max_line) : max_line_(max_line) {}

  // Takes bytes in any portions. False once a line was longer than the limit: the stream can't be trusted any more,
  // but the lines before it stand.
  bool push(std::string_view bytes);
  // The next complete line without its end; valid until the next push. Empty lines are skipped.
  std::optional<std::string_view> next();
  // What stands after the last line end: at the end of the stream it counts as a line.
  std::string_view rest() const { return std::string_view(buffer_).substr(begin_); }

 private:
  std::size_t max_line_;
  std::string buffer_;
  std::size_t begin_ = 0;    // of the line being looked for
  std::size_t scanned_ = 0;  // no line end before this
  std::size_t pending_ = 0;  // bytes since the last line end
  bool too_long_ = false;
};

}  // namespace posed::proto
