// What an ISOTRAK II is told. Like a FASTRAK's commands but for the output list, which is one for all stations.
// Source: the commands and their order as VRPN's driver has them from the ISOTRAK II manual.
#pragma once

#include <optional>
#include <string>

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
  void hear(const Reply& reply, Conversation& with) override;
  void leave(Conversation& with) override;

 private:
  bool ask_stations(Conversation& with);
  bool prefer(Conversation& with);

  IsotrakOptions options_;
  IsotrakDecoder decoder_;
  std::optional<unsigned> stations_;  // bit 0 is station 1: those that are switched on
  std::optional<unsigned> found_;     // those that were at first
};

}  // namespace posed::tracker
