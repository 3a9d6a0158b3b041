// HTTP/1.1: one request after the other, answered from the site; or the handshake of a WebSocket.
#pragma once

#include <string>

#include "server/net/face.h"
#include "server/net/http_site.h"
#include "server/net/server.h"

namespace posed::net {

class HttpFace : public Face {
 public:
  HttpFace(Link& link, HttpSite& site, const Limits& limits, Tally& tally);

  void take(std::string_view bytes) override;
  bool stuck() const override { return stuck_; }
  bool ready() const override { return stuck_ && link_.idle(); }
  void end() override { link_.part(0, std::nullopt, Link::Owed::forget); }

 private:
  bool take_one();  // false: no whole request is there, or it was the last one
  void answer(const HttpReply& reply, bool keep_alive, bool with_body);

  Link& link_;
  HttpSite& site_;
  const Limits& limits_;
  Tally& tally_;
  std::string buffer_;
  bool stuck_ = false;
  bool over_ = false;   // no further request is taken
  bool asked_ = false;  // a request has begun to arrive
};

}  // namespace posed::net
