#include "server/tracker/viper/session.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <tuple>
#include <utility>

#include "server/tracker/axes.h"
#include "server/tracker/conversation.h"
#include "server/tracker/little_endian.h"

namespace posed::tracker {
namespace {

constexpr int kRates[] = {30, 60, 120, 240, 480, 960};  // Hz, as it numbers them
constexpr std::array<std::uint32_t, 2> kMetresAndQuaternions{3, 2};
constexpr std::uint32_t kAllSensors = ~0u;
constexpr std::uint32_t kFilterNone = 0, kFilterCustom = 4;
constexpr std::uint32_t kFilterAttitude = 1, kFilterPosition = 2;

std::uint32_t bits_of(double value) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

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

// Which sensors are there is what is plugged in: no command of its documented ones switches them.
Abilities viper_abilities() {
  Abilities can;
  for (const int rate : kRates) can.rates.push_back(rate);
  can.stations = kViperMostSensors;
  can.hemispheres = can.follows = can.filters = true;
  return can;
}

Preferences viper_defaults() {
  const FilterSetting medium{true, 0.05, 0.05, 0.8, 0.95};
  return {240.0, std::nullopt, {{0, kX}}, medium, medium};
}

ViperSession::ViperSession(ViperOptions options) : options_(std::move(options)), decoder_(format_of(options_, 240)) {}

bool ViperSession::set_up(Conversation& with) {
  const std::string stop = viper_command(kViperContinuous, ViperAction::reset);
  if (!with.make_quiet({stop, stop, stop})) return false;
  decoder_ = ViperDecoder(format_of(options_, 240));
  const auto map = ask(kViperStationMap, ViperAction::get, with);
  if (!map) return false;
  if (!prefer(with)) return false;
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

const Reply* ViperSession::tell(ViperCommand command, std::span<const std::uint32_t> payload, ViperArguments about,
                                Conversation& with) {
  replies_.erase(command);
  const std::string bytes = viper_command(command, ViperAction::set, payload, about);
  if (with.ask(bytes, [&] { return replies_.contains(command); })) return &replies_[command];
  with.trouble(no_answer("VIPER", 0));
  return nullptr;
}

bool ViperSession::prefer(Conversation& with) {
  const Preferences wish = with.preferences();
  const auto refused = [&](const char* field, const Reply& reply) {
    if (reply.error != 0) with.complain(std::string("the tracker refuses ") + field + words_in(reply.body));
  };
  if (wish.rate_hz) {
    const auto* const rate = std::find(std::begin(kRates), std::end(kRates), static_cast<int>(*wish.rate_hz));
    const std::uint32_t code[] = {static_cast<std::uint32_t>(rate - std::begin(kRates))};
    const Reply* const reply = tell(kViperFrameRate, code, {}, with);
    if (!reply) return false;
    refused("rate_hz", *reply);
  }
  for (const auto& [station, zenith] : wish.hemispheres) {
    const ViperArguments about{station == 0 ? kAllSensors : static_cast<std::uint32_t>(station - 1), 0};
    const Vec3 v = world_from_source(zenith);  // a half turn is its own inverse
    const std::uint32_t follow = zenith == kZero ? 1 : 0;
    const std::uint32_t payload[] = {follow, bits_of(v.x), bits_of(v.y), bits_of(v.z)};
    const Reply* reply = tell(kViperHemisphere, payload, about, with);
    // One SDK has two words before the direction, another has their bits in one.
    if (reply && reply->error != 0) {
      const std::uint32_t longer[] = {follow, 0, payload[1], payload[2], payload[3]};
      reply = tell(kViperHemisphere, longer, about, with);
    }
    if (!reply) return false;
    refused("hemisphere", *reply);
  }
  for (const auto& [field, target, filter] : {std::tuple{"position_filter", kFilterPosition, wish.position_filter},
                                              {"attitude_filter", kFilterAttitude, wish.attitude_filter}}) {
    if (!filter) continue;
    const FilterSetting f = filter->on ? *filter : FilterSetting{false, 0.0, 1.0, 0.0, 0.0};
    const std::uint32_t payload[] = {filter->on ? kFilterCustom : kFilterNone, bits_of(f.sensitivity), bits_of(f.low),
                                     bits_of(f.high), bits_of(f.most)};
    const Reply* const reply = tell(kViperFilter, payload, {kAllSensors, target}, with);
    if (!reply) return false;
    refused(field, *reply);
  }
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
