#include "server/tracker/viper/session.h"

#include <array>
#include <bit>
#include <cctype>
#include <utility>

#include "server/tracker/conversation.h"
#include "server/tracker/little_endian.h"

namespace posed::tracker {
namespace {

constexpr int kRates[] = {30, 60, 120, 240, 480, 960};  // Hz, as it numbers them
constexpr std::array<std::uint32_t, 2> kMetresAndQuaternions{3, 2};

// A refusal comes with a block of information, whose words are worth telling.
std::string words_in(const std::vector<std::uint8_t>& body) {
  std::string longest, run;
  for (const std::uint8_t byte : body) {
    run = byte >= 0x20 && byte < 0x7f ? run + static_cast<char>(byte) : std::string();
    if (run.size() > longest.size()) longest = run;
  }
  return longest.size() < 4 ? std::string() : ": " + longest;
}

ViperFormat format_of(const ViperOptions& options, int rate_hz) {
  ViperFormat format;
  format.device = options.id;
  format.rate_hz = rate_hz;
  return format;
}

}  // namespace

ViperSession::ViperSession(ViperOptions options) : options_(std::move(options)), decoder_(format_of(options_, 240)) {}

bool ViperSession::set_up(Conversation& with) {
  const std::string stop = viper_command(kViperContinuous, ViperAction::reset);
  if (!with.make_quiet({stop, stop, stop})) return false;
  decoder_ = ViperDecoder(format_of(options_, 240));
  const auto map = ask(kViperStationMap, ViperAction::get, with);
  if (!map) return false;
  const auto rate = ask(kViperFrameRate, ViperAction::get, with);
  if (!rate) return false;
  if (!ask(kViperUnits, ViperAction::set, with, kMetresAndQuaternions)) return false;

  const std::uint32_t sensors = map->size() >= 4 ? u32_at(*map, 0) & 0xffff : 0;
  const std::uint32_t code = rate->size() >= 4 ? u32_at(*rate, 0) : 3;
  const int rate_hz = code < std::size(kRates) ? kRates[code] : 240;
  decoder_ = ViperDecoder(format_of(options_, rate_hz));
  with.begin(std::bit_width(sensors));
  with.nominal_rate(rate_hz);
  if (!ask(kViperContinuous, ViperAction::set, with)) return false;
  with.trouble(sensors == 0 ? "no sensor is plugged in" : "no data for 2 s: is the source plugged in?");
  return true;
}

std::optional<std::vector<std::uint8_t>> ViperSession::ask(ViperCommand command, ViperAction action, Conversation& with,
                                                           std::span<const std::uint32_t> payload) {
  replies_.erase(command);
  if (!with.ask(viper_command(command, action, payload), [&] { return replies_.contains(command); })) {
    with.trouble(no_answer("VIPER", 0));
    return std::nullopt;
  }
  const Reply& reply = replies_[command];
  if (reply.error == 0) return reply.body;
  with.trouble("the tracker refuses command " + std::to_string(command) + words_in(reply.body));
  return std::nullopt;
}

void ViperSession::hear(const Reply& reply, Conversation&) {
  replies_[reply.command] = reply;
}

void ViperSession::leave(Conversation& with) {
  with.write(viper_command(kViperContinuous, ViperAction::reset));
}

}  // namespace posed::tracker
