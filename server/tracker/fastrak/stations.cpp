#include "server/tracker/fastrak/stations.h"

#include <bit>
#include <utility>

#include "server/tracker/conversation.h"
#include "server/tracker/fastrak/reply.h"
#include "server/tracker/fastrak/settings.h"

namespace posed::tracker {

FastrakStations::FastrakStations(int most, std::string model, unsigned baud)
    : most_(most), model_(std::move(model)), baud_(baud) {}

bool FastrakStations::ask(Conversation& with) {
  stations_.reset();
  if (with.ask("l1\r", [this] { return stations_.has_value(); })) return true;
  with.trouble(no_answer(model_, baud_));
  return false;
}

bool FastrakStations::set_up(Conversation& with) {
  if (!ask(with)) return false;
  const Preferences wish = with.preferences();
  if (!found_) found_ = stations_;
  const auto switches = fastrak_switches(wish, most_, *stations_, *found_);
  for (const std::string& command : switches) {
    if (!with.write(command)) return false;
  }
  if (!switches.empty() && !ask(with)) return false;
  for (const std::string& command : fastrak_settings(wish, most_)) {
    if (!with.write(command)) return false;
  }
  return true;
}

bool FastrakStations::stream(double cycles_per_second, Conversation& with) const {
  with.begin(std::bit_width(*stations_));
  const int active = std::popcount(*stations_);
  with.nominal_rate(cycles_per_second / (active > 0 ? active : 1));
  with.trouble(active == 0 ? "no receiver is switched on: see the switches on its back"
                           : "no data for 2 s: are the transmitter and the receivers plugged in?");
  return with.write("C");
}

void FastrakStations::hear(const Reply& reply, Conversation& with) {
  if (reply.error != 0) {
    with.complain(complaint_text(reply.error));
  } else if (const auto stations = fastrak_stations(reply)) {
    stations_ = stations;
  }
}

std::optional<unsigned> fastrak_stations(const Reply& reply) {
  if (reply.command != 'l' || reply.body.size() > 4) return std::nullopt;
  unsigned stations = 0;
  for (std::size_t i = 0; i < reply.body.size(); ++i) {
    if (reply.body[i] != '0' && reply.body[i] != '1') return std::nullopt;
    stations |= static_cast<unsigned>(reply.body[i] - '0') << i;
  }
  return stations;
}

}  // namespace posed::tracker
