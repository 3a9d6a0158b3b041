#include "server/tracker/status_board.h"

#include <utility>

namespace posed::tracker {

StatusBoard::StatusBoard(Sink sink, double rate_hz) : sink_(std::move(sink)) {
  status_.rate_hz = rate_hz;
}

void StatusBoard::set(State state, std::string message) {
  const bool told = told_ != std::chrono::steady_clock::time_point{};
  if (told && state == status_.state && message == status_.message) return;
  status_.state = state;
  status_.message = std::move(message);
  tell();
}

void StatusBoard::pass_on(Frame frame) {
  ++status_.frames;
  status_.stations.resize(frame.samples.size());
  for (std::size_t i = 0; i < frame.samples.size(); ++i) status_.stations[i] = frame.samples[i].station;
  if (sink_.frame) sink_.frame(std::move(frame));
}

void StatusBoard::tick() {
  if (std::chrono::steady_clock::now() - told_ >= std::chrono::seconds(1)) tell();
}

void StatusBoard::tell() {
  told_ = std::chrono::steady_clock::now();
  if (sink_.status) sink_.status(status_);
}

}  // namespace posed::tracker
