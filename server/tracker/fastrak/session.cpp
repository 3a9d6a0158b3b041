#include "server/tracker/fastrak/session.h"

#include <cstdio>
#include <utility>

#include "server/tracker/conversation.h"

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
    : options_(std::move(options)), decoder_(make_decoder(options_)), stations_(kStations, "FASTRAK", options_.baud) {}

bool FastrakSession::set_up(Conversation& with) {
  // The CR ends what may stand half typed, and wakes one that has just been switched on. It draws a complaint, which is
  // thrown away here.
  if (!with.make_quiet({"\rc", "\rc", "\rc"})) return false;
  decoder_ = make_decoder(options_);
  if (!stations_.set_up(with)) return false;
  if (!with.write("u")) return false;  // centimetres
  for (int station = 1; station <= kStations; ++station) {
    if (stations_.on(station) && !configure(station, with)) return false;
  }
  // From the factory a stylus' button starts and stops the stream.
  if (!with.write("e1,0\r") || !with.write("f")) return false;
  decoder_ = make_decoder(options_);
  return stations_.stream(kCyclesPerSecond, with);
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

void FastrakSession::leave(Conversation& with) {
  with.write("c");
}

}  // namespace posed::tracker
