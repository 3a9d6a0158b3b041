#include "server/net/stream_frame.h"

#include "server/net/websocket_frames.h"

namespace posed::net {

StreamFrame::StreamFrame(std::string_view text, bool binary, Nanoseconds t_ns) : t_ns_(t_ns) {
  const FrameHeader header = frame_header(binary ? Opcode::binary : Opcode::text, text.size());
  header_ = header.size;
  std::string wire;
  wire.reserve(header_ + text.size() + 1);
  wire.append(header.bytes.data(), header_).append(text).append("\n");
  wire_ = std::make_shared<const std::string>(std::move(wire));
}

std::string_view StreamFrame::as(Framing framing) const {
  const std::string_view wire = *wire_;
  switch (framing) {
    case Framing::line:
      return wire.substr(header_);
    case Framing::text:
      return wire.substr(0, wire.size() - 1);
    case Framing::raw:
      break;
  }
  return wire.substr(header_, size());
}

}  // namespace posed::net
