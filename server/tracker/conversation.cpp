#include "server/tracker/conversation.h"

#include <algorithm>
#include <utility>

#include "common/log.h"
#include "server/tracker/capture/capture.h"

namespace posed::tracker {
namespace {

using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;

constexpr auto kSilence = 2s;       // without a frame: the stream has died
constexpr auto kQuiet = 100ms;      // without a byte: the device has stopped
constexpr auto kLongestDrain = 1s;  // a LIBERTY's buffer holds 2300 bytes
constexpr auto kAnswerTime = 300ms;
constexpr int kTries = 3;
constexpr std::chrono::milliseconds kFirstPause = 1s, kLongestPause = 30s;

}  // namespace

Conversation::Conversation(Line& line, Session& session, StatusBoard& board, Capture* capture,
                           const PreferenceBox& preferences, const std::atomic<bool>& stopping)
    : line_(line),
      session_(session),
      board_(board),
      capture_(capture),
      preferences_(preferences),
      stopping_(stopping) {}

void Conversation::run() {
  Milliseconds pause = kFirstPause;
  while (alive()) {
    board_.set(State::starting, "");
    complaint_.clear();
    trouble_.clear();
    begun_ = false;
    heeded_ = preferences_.version();
    const std::uint64_t before = board_.frames();
    const bool set_up = session_.set_up(*this);
    if (set_up && session_.may_rest()) return rest();
    if (set_up) listen(kSilence);
    if (!alive()) break;
    if (asked_anew()) continue;
    if (board_.frames() != before) pause = kFirstPause;
    board_.set(State::silent, all_trouble());
    // It may come back by itself, as when a sensor is plugged in; only then is it started anew.
    listen(pause);
    pause = std::min(2 * pause, kLongestPause);
  }
  if (line_.trouble() == Line::Trouble::none) session_.leave(*this);
}

bool Conversation::make_quiet(std::initializer_list<std::string_view> stops) {
  forgiving_ = true;
  for (const std::string_view stop : stops) {
    if (!write(stop)) return false;
    const auto begun = Steady::now();
    auto last = begun;
    while (alive() && Steady::now() - begun < kLongestDrain) {
      line_.wait(20ms);
      board_.tick();
      if (!line_.take().empty()) last = Steady::now();
      if (Steady::now() - last >= kQuiet) return true;
    }
    if (!alive()) return false;
  }
  trouble_ = "the tracker does not stop streaming: switch it off and on";
  return false;
}

bool Conversation::ask(std::string_view question, const std::function<bool()>& answered) {
  for (int i = 0; i < kTries && alive(); ++i) {
    if (!write(question)) return false;
    const auto begun = Steady::now();
    while (alive() && Steady::now() - begun < kAnswerTime) {
      line_.wait(20ms);
      board_.tick();
      hear();
      if (!answered()) continue;
      forgiving_ = false;
      return true;
    }
  }
  return false;
}

void Conversation::begin(int highest_station) {
  session_.decoder().expect_up_to(highest_station);
  if (capture_) capture_->begin(session_.decoder(), highest_station);
  begun_ = true;
  forgiving_ = false;
}

void Conversation::trouble(std::string message) {
  trouble_ = std::move(message);
}

void Conversation::complain(std::string message) {
  if (forgiving_) return;
  complaint_ = std::move(message);
  board_.set(board_.state(), board_.state() == State::streaming ? complaint_ : all_trouble());
}

void Conversation::listen(Milliseconds patience) {
  auto last = Steady::now();
  while (alive() && !asked_anew() && Steady::now() - last < patience) {
    line_.wait(100ms);
    const std::uint64_t before = board_.frames();
    hear();
    board_.tick();
    if (board_.frames() == before) continue;
    last = Steady::now();
    patience = kSilence;
  }
}

void Conversation::rest() {
  board_.set(State::streaming, "");
  while (alive()) {
    line_.wait(100ms);
    hear();
    board_.tick();
  }
}

void Conversation::hear() {
  for (const Chunk& chunk : line_.take()) {
    Decoder& decoder = session_.decoder();
    const std::uint64_t bad_before = decoder.bad_bytes();
    if (capture_ && begun_ && chunk.gap) capture_->lost();
    if (capture_ && begun_) capture_->bytes(chunk.bytes, chunk.t_ns);
    if (chunk.gap) decoder.lost_bytes();
    Heard heard = decoder.feed(chunk.bytes, chunk.t_ns);
    board_.add_bad_bytes(decoder.bad_bytes() - bad_before);
    for (const Reply& reply : heard.replies) session_.hear(reply, *this);
    if (!begun_ || heard.frames.empty()) continue;
    board_.set(State::streaming, complaint_);
    for (Frame& frame : heard.frames) board_.pass_on(std::move(frame));
  }
  if (!capture_ || capture_->good()) return;
  log_warning("the capture " + capture_->path() + " ends here: is the disk full?");
  capture_ = nullptr;
}

std::string Conversation::all_trouble() const {
  if (trouble_.empty() || complaint_.empty()) return trouble_ + complaint_;
  return trouble_ + "; " + complaint_;
}

std::string no_answer(std::string_view name, unsigned baud) {
  if (baud == 0) return "the tracker does not answer: switch it off and on";
  return "the tracker does not answer at " + std::to_string(baud) + " baud: is it switched on, is it a " +
         std::string(name) + ", is its cable the right one, do its switches say another rate?";
}

}  // namespace posed::tracker
