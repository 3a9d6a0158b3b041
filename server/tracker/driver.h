// A tracker of any family at any port: finds it, talks with it, finds it again. The one driver there is: a family is a
// Session, a way to reach it is a Port. One thread of its own; only Frames and Statuses leave it. What goes wrong is
// told in the Status, with the cure, and tried again.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "server/tracker/capture/capture.h"
#include "server/tracker/port.h"
#include "server/tracker/preferences.h"
#include "server/tracker/session.h"
#include "server/tracker/tracker.h"

namespace posed::tracker {

class StatusBoard;

struct DriverParts {
  std::string id;
  std::string kind;
  double rate_hz = 0;  // nominal, until a session knows better
  std::unique_ptr<Port> port;
  std::unique_ptr<Capture> capture;                        // null: none
  std::function<std::unique_ptr<Session>()> make_session;  // called on the driver's thread, once for each opened line
  Abilities can = {};                                      // that configure() may ask for
  Preferences defaults = {};                               // of the family, for what it can
};

class Driver final : public Tracker {
 public:
  explicit Driver(DriverParts parts);
  ~Driver() override;

  const std::string& id() const override { return parts_.id; }
  const std::string& kind() const override { return parts_.kind; }
  posed::Status configure(const Settings& settings) override;
  void start(Sink sink) override;
  void stop() override;

 private:
  void run(Sink sink);
  void rest(StatusBoard& board, std::chrono::milliseconds pause);

  DriverParts parts_;
  PreferenceBox preferences_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace posed::tracker
