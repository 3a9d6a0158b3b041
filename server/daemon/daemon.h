// The whole daemon in one object: the station loop, the network, the store and the trackers, wired together.
#pragma once

#include <memory>
#include <string>

#include "server/daemon/config.h"

namespace posed {

class Daemon {
 public:
  // Throws std::runtime_error with one clear sentence where it can't start.
  explicit Daemon(const Config& config);
  ~Daemon();

  std::uint16_t port() const;
  // Serves until stop() or a termination signal (if asked for), then stops cleanly: trackers first, then what peers are
  // owed, then the disk. Called once.
  void run(bool handle_signals);
  void stop();  // from any thread

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace posed
