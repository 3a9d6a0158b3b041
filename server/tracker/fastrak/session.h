// What a FASTRAK is told, on USB or at a serial port. Its commands are single letters, and c is not C.
// Source: FASTRAK manual OPM00PI002 Rev G, commands; their order as the public drivers (VRPN) have it.
#pragma once

#include <optional>
#include <string>

#include "server/tracker/fastrak/decoder.h"
#include "server/tracker/fastrak/stations.h"
#include "server/tracker/session.h"

namespace posed::tracker {

inline constexpr int kFastrakStations = 4;

struct FastrakOptions {
  std::string id = "fastrak";
  unsigned baud = 0;               // 0: on USB
  std::optional<Vec3> hemisphere;  // as LibertyOptions has it
};

class FastrakSession final : public Session {
 public:
  explicit FastrakSession(FastrakOptions options);

  Decoder& decoder() override { return decoder_; }
  bool set_up(Conversation& with) override;
  void hear(const Reply& reply, Conversation& with) override { stations_.hear(reply, with); }
  void leave(Conversation& with) override;

 private:
  bool configure(int station, Conversation& with) const;

  FastrakOptions options_;
  FastrakDecoder decoder_;
  FastrakStations stations_;
};

}  // namespace posed::tracker
