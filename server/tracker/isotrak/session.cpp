#include "server/tracker/isotrak/session.h"

#include <utility>

#include "server/tracker/conversation.h"

namespace posed::tracker {
namespace {

constexpr double kCyclesPerSecond = 60.0;  // which the stations share

IsotrakFormat format_of(const IsotrakOptions& options) {
  IsotrakFormat format;
  format.device = options.id;
  return format;
}

}  // namespace

IsotrakSession::IsotrakSession(IsotrakOptions options)
    : options_(std::move(options)),
      decoder_(format_of(options_)),
      stations_(kIsotrakStations, "ISOTRAK II", options_.baud) {}

bool IsotrakSession::set_up(Conversation& with) {
  // The CR ends what may stand half typed. It draws a complaint, which is thrown away here.
  if (!with.make_quiet({"\rc", "\rc", "\rc"})) return false;
  if (!with.write("F")) return false;  // ASCII, for the answers
  decoder_ = IsotrakDecoder(format_of(options_));
  if (!stations_.set_up(with)) return false;
  if (!with.write("u") || !with.write("O2,11\r") || !with.write("f")) return false;
  decoder_ = IsotrakDecoder(format_of(options_));
  return stations_.stream(kCyclesPerSecond, with);
}

void IsotrakSession::leave(Conversation& with) {
  with.write("c");
}

}  // namespace posed::tracker
