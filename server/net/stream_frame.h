// A stream's frame as it goes on the wire: a WebSocket header, the frame's text, a newline, in one piece. It is made
// once; each face sends its part of the same bytes.
#pragma once

#include <string_view>

#include "common/time.h"
#include "server/net/subscription.h"

namespace posed::net {

enum class Framing { raw, line, text };  // as it is; ended by a newline; as a WebSocket text frame

class StreamFrame {
 public:
  StreamFrame() = default;
  // `t_ns`: when what it tells of was so; 0: its age does not count.
  explicit StreamFrame(std::string_view text, bool binary = false, Nanoseconds t_ns = 0);

  explicit operator bool() const { return wire_ != nullptr; }
  std::size_t size() const { return wire_->size() - header_ - 1; }  // of the text
  std::string_view as(Framing framing) const;
  const SharedLine& wire() const { return wire_; }
  Nanoseconds t_ns() const { return t_ns_; }

 private:
  SharedLine wire_;
  std::size_t header_ = 0;
  Nanoseconds t_ns_ = 0;
};

}  // namespace posed::net
