#include "server/tracker/fastrak/session.h"

#include <bit>
#include <cstdio>
#include <utility>

#include "server/tracker/conversation.h"
#include "server/tracker/fastrak/reply.h"
#include "server/tracker/fastrak/settings.h"

namespace posed::tracker {
namespace {

constexpr double kCyclesPerSecond = 120.0;  // which the stations share
constexpr int kStations = kFastrakStations;

FastrakDecoder make_decoder(const FastrakOptions& options) {
  FastrakFormat format;
  format.device = options.id;
  return std::move(*FastrakDecoder::make(std::move(format)));
}

}  // namespace

FastrakSession::FastrakSession(FastrakOptions options)
    : options_(std::move(options)), decoder_(make_decoder(options_)) {}

bool FastrakSession::set_up(Conversation& with) {
  // The CR ends what may stand half typed, and wakes one that has just been switched on. It draws a complaint, which is
  // thrown away here.
  if (!with.make_quiet({"\rc", "\rc", "\rc"})) return false;
  decoder_ = make_decoder(options_);
  if (!ask_stations(with) || !prefer(with)) return false;
  if (!with.write("u")) return false;  // centimetres
  for (int station = 1; station <= kStations; ++station) {
    if ((*stations_ >> (station - 1) & 1) != 0 && !configure(station, with)) return false;
  }
  // From the factory a stylus' button starts and stops the stream.
  if (!with.write("e1,0\r") || !with.write("f")) return false;
  decoder_ = make_decoder(options_);
  with.begin(std::bit_width(*stations_));
  const int active = std::popcount(*stations_);
  with.nominal_rate(kCyclesPerSecond / (active > 0 ? active : 1));
  with.trouble(active == 0 ? "no receiver is switched on: see the switches on its back"
                           : "no data for 2 s: are the transmitter and the receivers plugged in?");
  return with.write("C");
}

bool FastrakSession::ask_stations(Conversation& with) {
  stations_.reset();
  if (with.ask("l1\r", [this] { return stations_.has_value(); })) return true;
  with.trouble(no_answer("FASTRAK", options_.baud));
  return false;
}

// What has been asked of the device, and no more: what somebody has set in it stays.
bool FastrakSession::prefer(Conversation& with) {
  const Preferences wish = with.preferences();
  if (!found_) found_ = stations_;
  const auto switches = fastrak_switches(wish, kStations, *stations_, *found_);
  for (const std::string& command : switches) {
    if (!with.write(command)) return false;
  }
  if (!switches.empty() && !ask_stations(with)) return false;
  for (const std::string& command : fastrak_settings(wish, kStations)) {
    if (!with.write(command)) return false;
  }
  return true;
}

bool FastrakSession::configure(int station, Conversation& with) const {
  char text[80];
  if (options_.hemisphere) {
    const Vec3 v = world_from_source(*options_.hemisphere);  // a half turn is its own inverse
    std::snprintf(text, sizeof text, "H%d,%.4f,%.4f,%.4f\r", station, v.x, v.y, v.z);
    if (!with.write(text)) return false;
  }
  std::snprintf(text, sizeof text, "O%d,2,11,16,0\r", station);
  return with.write(text);
}

void FastrakSession::hear(const Reply& reply, Conversation& with) {
  if (reply.error != 0) {
    with.complain(complaint_text(reply.error));
  } else if (const auto stations = fastrak_stations(reply)) {
    stations_ = stations;
  }
}

void FastrakSession::leave(Conversation& with) {
  with.write("c");
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
