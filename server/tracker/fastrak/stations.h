// The stations of a FASTRAK or an ISOTRAK II: which are switched on, and what is told of all of them alike.
// Source: FASTRAK manual OPM00PI002 Rev G, command l; VRPN's driver has it of the ISOTRAK II, too.
#pragma once

#include <optional>
#include <string>

#include "server/tracker/session.h"

namespace posed::tracker {

class FastrakStations {
 public:
  // `most`: the highest that there can be. `model` and `baud` (0: on USB) for what to tell where it does not answer.
  FastrakStations(int most, std::string model, unsigned baud);

  // Asks which are on, and says what has been asked of the device, and no more: what somebody has set in it stays.
  bool set_up(Conversation& with);
  bool on(int station) const { return stations_ && (*stations_ >> (station - 1) & 1) != 0; }
  // The last words: the stream begins. They share the cycles.
  bool stream(double cycles_per_second, Conversation& with) const;
  void hear(const Reply& reply, Conversation& with);

 private:
  bool ask(Conversation& with);

  int most_;
  std::string model_;
  unsigned baud_;
  std::optional<unsigned> stations_;  // bit 0 is station 1: those that are switched on
  std::optional<unsigned> found_;     // those that were at first
};

// The answer to l1, as "1100": a digit a station. Nothing where it is something else.
std::optional<unsigned> fastrak_stations(const Reply& reply);

}  // namespace posed::tracker
