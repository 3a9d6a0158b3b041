#include "server/tracker/liberty/session.h"

#include <bit>
#include <cstdio>
#include <utility>

#include "server/tracker/conversation.h"
#include "server/tracker/liberty/header.h"

namespace posed::tracker {
namespace {

// A serial line has no byte to spare: without the time stamp, which the frame count tells better, and where it is full
// without the distortion, which is advice, while a button is used.
const std::vector<int> kListOnUsb{8, 9, 10, 11, 3, 7}, kListOnSerial{9, 10, 11, 3, 7}, kShortList{9, 10, 3, 7};
constexpr int kSerialRecord = 48, kShortRecord = 44, kBitsPerByte = 10;
constexpr double kLineUse = 0.97;  // the device's clock and the line's are two

std::string list_command(const std::vector<int>& items) {
  std::string text = "O*";
  for (const int item : items) text += "," + std::to_string(item);
  return text + "\r";
}

LibertyDecoder make_decoder(const LibertyOptions& options, int rate_hz, const std::vector<int>& items = kListOnUsb) {
  LibertyFormat format;
  format.device = options.id;
  format.tag = options.family.tag;
  format.stations = options.family.stations;
  format.items = items;
  format.metres_per_unit = kMetresPerCentimetre;  // U1
  format.rate_hz = rate_hz;
  return std::move(*LibertyDecoder::make(std::move(format)));
}

std::string hemisphere_command(const Vec3& zenith) {
  const Vec3 v = world_from_source(zenith);  // a half turn is its own inverse
  char text[80];
  std::snprintf(text, sizeof text, "H*,%.4f,%.4f,%.4f\r", v.x, v.y, v.z);
  return text;
}

}  // namespace

Abilities liberty_abilities(const LibertyFamily& family) {
  Abilities can;
  can.stations = family.stations;
  can.switches = can.hemispheres = can.follows = can.filters = true;
  if (family.half_rate_hz) can.rates = {static_cast<double>(family.rate_hz), static_cast<double>(family.half_rate_hz)};
  return can;
}

Preferences liberty_defaults(const LibertyFamily& family) {
  return {static_cast<double>(family.rate_hz), std::vector<int>{}, {{0, kX}}, FilterSetting{}, FilterSetting{}};
}

LibertySession::LibertySession(LibertyOptions options)
    : options_(std::move(options)), decoder_(make_decoder(options_, options_.family.rate_hz)) {}

bool LibertySession::set_up(Conversation& with) {
  // P takes no CR. From the second try on a CR ends what may stand half typed before it.
  if (!with.make_quiet({"p", "\rp", "\rp"})) return false;
  decoder_ = make_decoder(options_, options_.family.rate_hz);
  // These are silent where they succeed. Units and rate are set since the device may have kept others; buffering in the
  // device is switched off so that a late read gets the newest frame instead of an old one.
  if (!with.write("F1\r") || !with.write("U1\r")) return false;
  if (!serial() && !with.write("@B0\r")) return false;
  if (!prefer(with) || !ask_stations(with)) return false;
  const int rate_hz = choose_rate(std::popcount(*stations_), with);
  if (options_.family.half_rate_hz && !with.write(rate_hz == options_.family.rate_hz ? "R4\r" : "R3\r")) return false;
  if (options_.hemisphere && !with.write(hemisphere_command(*options_.hemisphere))) return false;
  const std::vector<int>& list = choose_list(std::popcount(*stations_) * rate_hz);
  // In its other mode a stylus' button starts and stops the stream.
  if (!with.write("L*,0\r") || !with.write(list_command(list))) return false;
  decoder_ = make_decoder(options_, rate_hz, list);
  with.begin(std::bit_width(*stations_));
  with.nominal_rate(rate_hz);
  with.trouble(*stations_ == 0 ? "no sensor is plugged in" : "no data for 2 s: is the source plugged in?");
  return with.write("C\r");
}

bool LibertySession::ask_stations(Conversation& with) {
  stations_.reset();
  if (with.ask("\x15"
               "0\r",
               [this] { return stations_.has_value(); }))
    return true;
  with.trouble(no_answer(options_.family.name, options_.baud));
  return false;
}

// What has been asked of the device, and no more: what somebody has set in it stays.
bool LibertySession::prefer(Conversation& with) const {
  const Preferences wish = with.preferences();
  char text[80];
  if (wish.stations) {
    unsigned map = 0;
    for (const int station : *wish.stations) map |= 1u << (station - 1);
    if (wish.stations->empty()) map = (1u << options_.family.stations) - 1;
    std::snprintf(text, sizeof text, "\x15%d,%X\r", 0, map);
    if (!with.write(text)) return false;
  }
  for (const auto& [station, zenith] : wish.hemispheres) {
    const Vec3 v = world_from_source(zenith);  // a half turn is its own inverse
    const std::string whose = station == 0 ? "*" : std::to_string(station);
    std::snprintf(text, sizeof text, "H%s,%.4f,%.4f,%.4f\r", whose.c_str(), v.x, v.y, v.z);
    if (!with.write(text)) return false;
  }
  for (const auto& [letter, filter] : {std::pair{'X', wish.position_filter}, {'Y', wish.attitude_filter}}) {
    if (!filter) continue;
    const FilterSetting f = filter->on ? *filter : FilterSetting{false, 0.0, 1.0, 0.0, 0.0};
    std::snprintf(text, sizeof text, "%c%.3f,%.3f,%.3f,%.3f\r", letter, f.sensitivity, f.low, f.high, f.most);
    if (!with.write(text)) return false;
  }
  return true;
}

// What a serial line carries is less than what the device measures.
int LibertySession::choose_rate(int sensors, Conversation& with) const {
  const LibertyFamily& family = options_.family;
  const int most = serial() ? static_cast<int>(options_.baud) / kBitsPerByte / kShortRecord : 1'000'000;
  const std::optional<double> wish = with.preferences().rate_hz;
  const bool slow = wish && *wish == family.half_rate_hz;
  if (!slow && sensors * family.rate_hz <= most) return family.rate_hz;
  const int slower = family.half_rate_hz ? family.half_rate_hz : family.rate_hz;
  if (sensors * slower > most) {
    with.complain(std::to_string(options_.baud) + " baud do not carry " + std::to_string(sensors) + " sensors at " +
                  std::to_string(slower) + " Hz, so that frames will be missing: use USB, or fewer sensors");
  }
  return slower;
}

const std::vector<int>& LibertySession::choose_list(int records_per_second) const {
  if (!serial()) return kListOnUsb;
  return records_per_second * kSerialRecord * kBitsPerByte <= kLineUse * options_.baud ? kListOnSerial : kShortList;
}

void LibertySession::hear(const Reply& reply, Conversation& with) {
  if (reply.error != 0) {
    with.complain("the tracker says: " + std::string(liberty_error_text(static_cast<std::uint8_t>(reply.error))) +
                  " (error " + std::to_string(reply.error) + ")");
  } else if (reply.command == kCommandActiveStations && reply.body.size() == 4) {
    // One half lists the detected, the other the active ones. The sources differ on which comes first; both must be
    // set.
    stations_ = (reply.body[0] | reply.body[1] << 8) & (reply.body[2] | reply.body[3] << 8);
  }
}

void LibertySession::leave(Conversation& with) {
  with.write("p");
}

}  // namespace posed::tracker
