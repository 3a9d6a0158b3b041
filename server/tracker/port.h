// Where a tracker's line is found, again and again: on USB, at a serial port. Owned by a driver and used on its thread;
// interrupt() may be called from any.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "server/tracker/line.h"
#include "server/tracker/tracker.h"

namespace posed::tracker {

// Let go of the line before its port.
struct Opened {
  std::unique_ptr<Line> line;      // null: there is none
  State state = State::searching;  // then: searching where nothing is there, failed where it cannot be opened
  std::string message;             // and why, with the cure
};

class Port {
 public:
  virtual ~Port() = default;
  virtual Opened open(const std::function<bool()>& stopping) = 0;  // `stopping` ends its waits
  // Waits; true where something came or went, so that it is worth another look.
  virtual bool rest(std::chrono::milliseconds at_most) = 0;
  virtual void interrupt() = 0;  // ends a wait of the port or of its line
};

}  // namespace posed::tracker
