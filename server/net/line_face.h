// JSON lines on raw TCP.
#pragma once

#include "proto/framing.h"
#include "server/net/face.h"

namespace posed::net {

Error line_too_long(std::size_t max_line);

class LineFace : public Face {
 public:
  LineFace(Link& link, std::size_t max_line) : link_(link), max_line_(max_line), splitter_(max_line) {}

  void take(std::string_view bytes) override;
  bool stuck() const override { return stuck_; }
  bool ready() const override { return stuck_ && link_.room(); }
  void end() override;

 private:
  Link& link_;
  std::size_t max_line_;
  proto::LineSplitter splitter_;
  bool stuck_ = false;
  bool too_long_ = false;
};

}  // namespace posed::net
