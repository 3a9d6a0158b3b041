// The station loop: one thread on which all domain state lives. Others post to it.
#pragma once

#include <functional>
#include <memory>

#include "common/time.h"

namespace posed {

class Loop {
 public:
  Loop();
  ~Loop();

  void post(std::function<void()> task);                      // from any thread; in order
  void after(Nanoseconds delay, std::function<void()> task);  // on the loop's own thread only
  // The handler is called on the loop for each of SIGINT and SIGTERM.
  void on_termination(std::function<void()> handler);
  void run();   // until stop
  void stop();  // from any thread; tasks posted before it are still run

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace posed
