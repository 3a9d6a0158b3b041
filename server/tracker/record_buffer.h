// The loop that all decoders share: bytes that may be cut anywhere are searched for records; what is none is skipped
// one byte at a time (the true start may lie inside what looked like one) and counted. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace posed::tracker {

class RecordBuffer {
 public:
  static constexpr std::size_t kPartial = SIZE_MAX;  // the start of a record: wait for the rest

  // `examine(rest, in_step)` looks at what `rest` begins with, takes it where it is a record, and returns its size; 0:
  // it is none; kPartial. in_step: the last record ended where this one begins.
  template <class Examine>
  void feed(std::span<const std::uint8_t> bytes, Examine examine) {
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    std::size_t at = 0;
    while (at < buffer_.size()) {
      const std::size_t size = examine(std::span<const std::uint8_t>(buffer_).subspan(at), in_step_);
      if (size == kPartial) break;
      in_step_ = size > 0;
      bad_bytes_ += size > 0 ? 0 : 1;
      at += size > 0 ? size : 1;
    }
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(at));
  }

  void lost_bytes() {  // what is in hand is no record any more
    bad_bytes_ += buffer_.size();
    buffer_.clear();
    in_step_ = false;
  }
  std::uint64_t bad_bytes() const { return bad_bytes_; }

 private:
  std::vector<std::uint8_t> buffer_;  // the start of a record that has not come whole yet
  bool in_step_ = true;
  std::uint64_t bad_bytes_ = 0;
};

}  // namespace posed::tracker
