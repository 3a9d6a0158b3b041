// The WebSocket at /ws, after its handshake: a text frame is a line.
#pragma once

#include "server/net/face.h"
#include "server/net/websocket_frames.h"

namespace posed::net {

class WebsocketFace : public Face {
 public:
  WebsocketFace(Link& link, std::size_t max_line) : link_(link), max_line_(max_line), reader_(max_line) {}

  void take(std::string_view bytes) override;
  bool stuck() const override { return stuck_; }
  bool ready() const override { return stuck_ && link_.room(); }
  void end() override { link_.part(close_code::kNormal, std::nullopt, Link::Owed::forget); }
  SharedLine heartbeat() const override;
  SharedLine goodbye(std::uint16_t close_code) const override;

 private:
  void take(const FrameReader::Message& message);

  Link& link_;
  std::size_t max_line_;
  FrameReader reader_;
  bool stuck_ = false;
  bool parted_ = false;
};

}  // namespace posed::net
