#include "server/tracker/driver.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "server/tracker/conversation.h"
#include "server/tracker/status_board.h"

namespace posed::tracker {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kFirstRest = 250ms, kLongestRest = 4s;

}  // namespace

Driver::Driver(DriverParts parts) : parts_(std::move(parts)) {}

Driver::~Driver() {
  stop();
}

posed::Status Driver::configure(const Settings& settings) {
  if (posed::Status refused = refuse(settings, parts_.kind, parts_.can); !refused) return refused;
  preferences_.take(settings, parts_.defaults);
  return Ok{};
}

void Driver::start(Sink sink) {
  thread_ = std::thread([this, sink = std::move(sink)]() mutable { run(std::move(sink)); });
}

void Driver::stop() {
  stopping_ = true;
  parts_.port->interrupt();
  if (thread_.joinable()) thread_.join();
}

void Driver::run(Sink sink) {
  StatusBoard board(std::move(sink), parts_.rate_hz);
  board.set(State::searching, "");
  auto pause = kFirstRest;
  while (!stopping_) {
    Opened opened = parts_.port->open([this] { return stopping_.load(); });
    if (stopping_) break;
    if (opened.line) {
      const std::uint64_t before = board.frames();
      const auto session = parts_.make_session();
      Capture* const capture = parts_.capture && parts_.capture->good() ? parts_.capture.get() : nullptr;
      Conversation(*opened.line, *session, board, capture, preferences_, stopping_).run();
      if (board.frames() != before) pause = kFirstRest;
      opened = {};
      if (!stopping_) board.set(State::searching, "the line to the tracker broke: is its cable loose?");
    } else {
      board.set(opened.state, std::move(opened.message));
    }
    rest(board, pause);
    pause = std::min(2 * pause, kLongestRest);
  }
}

// Until something comes or goes, but no longer than `pause`: not every system announces devices.
void Driver::rest(StatusBoard& board, std::chrono::milliseconds pause) {
  const auto deadline = std::chrono::steady_clock::now() + pause;
  while (!stopping_ && std::chrono::steady_clock::now() < deadline) {
    if (parts_.port->rest(100ms)) return;
    board.tick();
  }
}

}  // namespace posed::tracker
