#include "server/net/line_face.h"

#include "server/net/websocket_frames.h"

namespace posed::net {

Error line_too_long(std::size_t max_line) {
  return {"too_large", "a line holds at most " + std::to_string(max_line) + " bytes", "", "send less at once"};
}

void LineFace::take(std::string_view bytes) {
  if (!bytes.empty() && !splitter_.push(bytes)) too_long_ = true;
  for (;;) {
    stuck_ = !link_.room();
    if (stuck_) return;
    const auto line = splitter_.next();
    if (!line) break;
    link_.hand_up(*line);
  }
  if (too_long_) link_.part(close_code::kTooBig, line_too_long(max_line_), Link::Owed::wait);
}

void LineFace::end() {
  std::string_view rest = splitter_.rest();
  if (rest.ends_with('\r')) rest.remove_suffix(1);
  if (!rest.empty() && !too_long_) link_.hand_up(rest);
}

}  // namespace posed::net
