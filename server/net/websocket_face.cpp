#include "server/net/websocket_face.h"

#include "server/net/line_face.h"

namespace posed::net {

void WebsocketFace::take(std::string_view bytes) {
  if (!bytes.empty()) reader_.push(bytes);
  while (!parted_) {
    stuck_ = !link_.room();
    if (stuck_) return;
    auto message = reader_.next();
    if (!message) break;
    take(*message);
  }
  if (parted_ || reader_.error() == 0) return;
  parted_ = true;
  std::optional<Error> last_words;
  if (reader_.error() == close_code::kTooBig) last_words = line_too_long(max_line_);
  link_.part(reader_.error(), std::move(last_words), Link::Owed::wait);
}

void WebsocketFace::take(const FrameReader::Message& message) {
  switch (message.opcode) {
    case Opcode::text:
      return link_.hand_up(message.payload);
    case Opcode::ping:
      return link_.send(std::make_shared<const std::string>(control_frame(Opcode::pong, message.payload)));
    case Opcode::binary:
      parted_ = true;
      return link_.part(close_code::kUnsupported, std::nullopt, Link::Owed::wait);
    case Opcode::close:
      parted_ = true;
      return link_.part(close_code::kNormal, std::nullopt, Link::Owed::forget);
    case Opcode::pong:
    case Opcode::continuation:
      return;
  }
}

SharedLine WebsocketFace::heartbeat() const {
  return std::make_shared<const std::string>(control_frame(Opcode::ping, ""));
}

SharedLine WebsocketFace::goodbye(std::uint16_t close_code) const {
  return std::make_shared<const std::string>(close_frame(close_code, ""));
}

}  // namespace posed::net
