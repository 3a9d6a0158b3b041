#include "server/tracker/isotrak/session.h"

#include <bit>
#include <utility>

#include "server/tracker/conversation.h"
#include "server/tracker/fastrak/reply.h"
#include "server/tracker/fastrak/session.h"
#include "server/tracker/fastrak/settings.h"

namespace posed::tracker {
namespace {

constexpr double kCyclesPerSecond = 60.0;  // which the stations share

IsotrakFormat format_of(const IsotrakOptions& options) {
  IsotrakFormat format;
  format.device = options.id;
  return format;
}

}  // namespace

IsotrakSession::IsotrakSession(IsotrakOptions options) : options_(std::move(options)), decoder_(format_of(options_)) {}

bool IsotrakSession::set_up(Conversation& with) {
  // The CR ends what may stand half typed. It draws a complaint, which is thrown away here.
  if (!with.make_quiet({"\rc", "\rc", "\rc"})) return false;
  if (!with.write("F")) return false;  // ASCII, for the answers
  decoder_ = IsotrakDecoder(format_of(options_));
  if (!ask_stations(with) || !prefer(with)) return false;
  if (!with.write("u") || !with.write("O2,11\r") || !with.write("f")) return false;
  decoder_ = IsotrakDecoder(format_of(options_));
  with.begin(std::bit_width(*stations_));
  const int active = std::popcount(*stations_);
  with.nominal_rate(kCyclesPerSecond / (active > 0 ? active : 1));
  with.trouble(active == 0 ? "no receiver is switched on: see the switches on its back"
                           : "no data for 2 s: are the transmitter and the receivers plugged in?");
  return with.write("C");
}

bool IsotrakSession::ask_stations(Conversation& with) {
  stations_.reset();
  if (with.ask("l1\r", [this] { return stations_.has_value(); })) return true;
  with.trouble(no_answer("ISOTRAK II", options_.baud));
  return false;
}

bool IsotrakSession::prefer(Conversation& with) {
  const Preferences wish = with.preferences();
  if (!found_) found_ = stations_;
  const auto switches = fastrak_switches(wish, kIsotrakStations, *stations_, *found_);
  for (const std::string& command : switches) {
    if (!with.write(command)) return false;
  }
  if (!switches.empty() && !ask_stations(with)) return false;
  for (const std::string& command : fastrak_settings(wish, kIsotrakStations)) {
    if (!with.write(command)) return false;
  }
  return true;
}

void IsotrakSession::hear(const Reply& reply, Conversation& with) {
  if (reply.error != 0) {
    with.complain(complaint_text(reply.error));
  } else if (const auto stations = fastrak_stations(reply)) {
    stations_ = stations;
  }
}

void IsotrakSession::leave(Conversation& with) {
  with.write("c");
}

}  // namespace posed::tracker
