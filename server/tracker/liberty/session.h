// What the LIBERTY family is told: LIBERTY and PATRIOT, on USB or at a serial port.
// Source: LIBERTY User Manual URM03PH156 Rev H, commands; their order as the public drivers have it. PATRIOT takes the
// same commands.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/tracker/liberty/decoder.h"
#include "server/tracker/preferences.h"
#include "server/tracker/session.h"

namespace posed::tracker {

struct LibertyFamily {
  std::string_view kind;
  std::string_view name;
  std::array<char, 2> tag;
  int stations;
  int rate_hz;
  int half_rate_hz;  // that it can be told instead; 0: it has one rate
};

inline constexpr LibertyFamily kLiberty{"liberty", "LIBERTY", {'L', 'Y'}, 16, 240, 120};
inline constexpr LibertyFamily kPatriot{"patriot", "PATRIOT", {'P', 'A'}, 2, 60, 0};

struct LibertyOptions {
  std::string id = "liberty";
  LibertyFamily family = kLiberty;
  unsigned baud = 0;  // 0: on USB
  // The half of the field in which the sensors are: its zenith, world axes. Unset: as the device has it (its forward
  // half from the factory). A sensor beyond the boundary is reported mirrored, not as out of range.
  std::optional<Vec3> hemisphere;
};

// What tracker.configure may ask of it, and what it is from the factory.
Abilities liberty_abilities(const LibertyFamily& family);
Preferences liberty_defaults(const LibertyFamily& family);

class LibertySession final : public Session {
 public:
  explicit LibertySession(LibertyOptions options);

  Decoder& decoder() override { return decoder_; }
  bool set_up(Conversation& with) override;
  void hear(const Reply& reply, Conversation& with) override;
  void leave(Conversation& with) override;

 private:
  bool serial() const { return options_.baud > 0; }
  int choose_rate(int sensors, Conversation& with) const;
  const std::vector<int>& choose_list(int records_per_second) const;
  bool ask_stations(Conversation& with);
  bool prefer(Conversation& with) const;

  LibertyOptions options_;
  LibertyDecoder decoder_;
  std::optional<unsigned> stations_;  // bit 0 is station 1: those that are plugged in and switched on
};

}  // namespace posed::tracker
