#include "server/tracker/liberty_session.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <utility>

#include "server/tracker/liberty_header.h"

namespace posed::tracker {
namespace {

using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;

constexpr auto kSilence = 2s;       // without a frame: the stream has died
constexpr auto kQuiet = 100ms;      // without a byte: the device has stopped
constexpr auto kLongestDrain = 1s;  // its buffer holds 2300 bytes
constexpr auto kAnswerTime = 300ms;
constexpr int kTries = 3;
constexpr std::chrono::milliseconds kFirstPause = 1s, kLongestPause = 30s;

LibertyDecoder make_decoder(const LibertyModel& model, const LibertyDriverOptions& options) {
  LibertyFormat format;
  format.device = options.id;
  format.tag = model.tag;
  format.stations = model.stations;
  format.metres_per_unit = kMetresPerCentimetre;  // U1
  format.rate_hz = model.rate_hz;
  return std::move(*LibertyDecoder::make(std::move(format)));
}

std::string hemisphere_command(const Vec3& zenith) {
  const Vec3 v = world_from_source(zenith);  // a half turn is its own inverse
  char text[80];
  std::snprintf(text, sizeof text, "H*,%.4f,%.4f,%.4f\r", v.x, v.y, v.z);
  return text;
}

}  // namespace

LibertySession::LibertySession(UsbBus& bus, UsbPipe& pipe, const LibertyModel& model,
                               const LibertyDriverOptions& options, StatusBoard& board,
                               const std::atomic<bool>& stopping)
    : bus_(bus),
      pipe_(pipe),
      options_(options),
      board_(board),
      stopping_(stopping),
      decoder_(make_decoder(model, options)),
      rate_hz_(model.rate_hz) {}

void LibertySession::run() {
  Milliseconds pause = kFirstPause;
  while (alive()) {
    board_.set(State::starting, "");
    const std::uint64_t before = board_.frames();
    if (set_up()) listen(kSilence);
    if (!alive()) break;
    if (board_.frames() != before) pause = kFirstPause;
    board_.set(State::silent, trouble_ + (complaint_.empty() ? "" : "; " + complaint_));
    // It may come back by itself, as when a sensor is plugged in; only then is it started anew.
    listen(pause);
    pause = std::min(2 * pause, kLongestPause);
  }
  if (pipe_.trouble() == UsbPipe::Trouble::none) pipe_.write("p");
}

bool LibertySession::set_up() {
  complaint_.clear();
  if (!make_quiet()) return false;
  decoder_.restart();
  // These are silent where they succeed. Units and rate are set since the device may have kept others; buffering in the
  // device is switched off so that a late read gets the newest frame instead of an old one.
  if (!pipe_.write("F1\r") || !pipe_.write("U1\r") || !pipe_.write("@B0\r")) return false;
  if (!pipe_.write(rate_hz_ == 240 ? "R4\r" : "R3\r")) return false;
  if (!ask_stations()) return false;
  if (options_.hemisphere && !pipe_.write(hemisphere_command(*options_.hemisphere))) return false;
  if (!pipe_.write("O*,8,9,11,3,7\r")) return false;
  decoder_.expect_up_to(std::bit_width(*stations_));
  trouble_ = *stations_ == 0 ? "no sensor is plugged in" : "no data for 2 s: is the source plugged in?";
  return pipe_.write("C\r");
}

// A program that crashed leaves the device streaming, with its buffer full and perhaps half a command typed.
bool LibertySession::make_quiet() {
  for (int i = 0; i < kTries && alive(); ++i) {
    // P takes no CR. From the second try on a CR ends what may stand half typed before it.
    if (!pipe_.write(i == 0 ? "p" : "\rp")) return false;
    const auto begun = Steady::now();
    auto last = begun;
    while (alive() && Steady::now() - begun < kLongestDrain) {
      bus_.handle_events(20ms);
      board_.tick();
      if (!pipe_.take().empty()) last = Steady::now();
      if (Steady::now() - last >= kQuiet) return true;
    }
  }
  trouble_ = "the tracker does not stop streaming: switch it off and on";
  return false;
}

bool LibertySession::ask_stations() {
  stations_.reset();
  for (int i = 0; i < kTries && alive(); ++i) {
    if (!pipe_.write("\x15"
                     "0\r"))
      return false;
    const auto begun = Steady::now();
    while (alive() && Steady::now() - begun < kAnswerTime) {
      bus_.handle_events(20ms);
      board_.tick();
      decode();
      if (stations_) return true;
    }
  }
  trouble_ = "the tracker does not answer: switch it off and on";
  return false;
}

void LibertySession::listen(Milliseconds patience) {
  auto last = Steady::now();
  while (alive() && Steady::now() - last < patience) {
    bus_.handle_events(100ms);
    const std::uint64_t before = board_.frames();
    decode();
    board_.tick();
    if (board_.frames() == before) continue;
    last = Steady::now();
    patience = kSilence;
  }
}

void LibertySession::decode() {
  for (const UsbChunk& chunk : pipe_.take()) {
    const std::uint64_t bad_before = decoder_.bad_bytes();
    if (chunk.gap) decoder_.lost_bytes();
    LibertyOutput out = decoder_.feed(chunk.bytes, chunk.t_ns);
    board_.add_bad_bytes(decoder_.bad_bytes() - bad_before);
    for (const LibertyReply& reply : out.replies) hear(reply);
    if (!out.frames.empty()) board_.set(State::streaming, complaint_);
    for (Frame& frame : out.frames) board_.pass_on(std::move(frame));
  }
}

void LibertySession::hear(const LibertyReply& reply) {
  if (reply.error != 0) {
    complaint_ = "the tracker says: " + std::string(liberty_error_text(reply.error)) + " (error " +
                 std::to_string(reply.error) + ")";
    board_.set(board_.state(), complaint_);
  } else if (reply.command == kCommandActiveStations && reply.body.size() == 4) {
    // One half lists the detected, the other the active ones. The sources differ on which comes first; both must be
    // set.
    stations_ = (reply.body[0] | reply.body[1] << 8) & (reply.body[2] | reply.body[3] << 8);
  }
}

}  // namespace posed::tracker
