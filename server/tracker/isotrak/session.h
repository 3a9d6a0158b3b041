// What an ISOTRAK II is told. Like a FASTRAK's commands but for the output list, which is one for all stations.
// Source: the commands and their order as VRPN's driver has them from the ISOTRAK II manual.
#pragma once

#include <string>

#include "server/tracker/fastrak/stations.h"
#include "server/tracker/isotrak/decoder.h"
#include "server/tracker/session.h"

namespace posed::tracker {

inline constexpr int kIsotrakStations = 2;

struct IsotrakOptions {
  std::string id = "isotrak";
  unsigned baud = 19200;
};

class IsotrakSession final : public Session {
 public:
  explicit IsotrakSession(IsotrakOptions options);

  Decoder& decoder() override { return decoder_; }
  bool set_up(Conversation& with) override;
  void hear(const Reply& reply, Conversation& with) override { stations_.hear(reply, with); }
  void leave(Conversation& with) override;

 private:
  IsotrakOptions options_;
  IsotrakDecoder decoder_;
  FastrakStations stations_;
};

}  // namespace posed::tracker
