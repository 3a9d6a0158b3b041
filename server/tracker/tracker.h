// The one interface of every tracker: simulated, on USB, replayed.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/frame.h"
#include "common/result.h"
#include "server/tracker/settings.h"

namespace posed::tracker {

enum class State { searching, starting, streaming, silent, failed };

struct Status {
  State state = State::searching;
  std::string message;   // what is wrong and what to do, or empty
  double rate_hz = 0.0;  // nominal
  std::uint64_t frames = 0;
  std::uint64_t bad_bytes = 0;  // skipped on the way back into step
  std::vector<int> stations;    // seen last
};

// Called on the tracker's own thread, in order; they must not block and must not call back into the tracker.
struct Sink {
  std::function<void(Frame)> frame;
  std::function<void(Status)> status;  // whenever the state or the message changes, and about once a second
};

class Tracker {
 public:
  virtual ~Tracker() = default;                 // stops
  virtual const std::string& id() const = 0;    // "simulated": the device part of its sensors' ids
  virtual const std::string& kind() const = 0;  // "liberty"
  // What its device is to do differently from now on; while it is away, when it is back. Called on any one thread.
  // Errors: "not_available" for what the family can not do, with the field as path ("/rate_hz").
  virtual posed::Status configure(const Settings& settings);
  virtual void start(Sink sink) = 0;  // once
  virtual void stop() = 0;            // joins the thread; no call to the sink after it returns
};

}  // namespace posed::tracker
