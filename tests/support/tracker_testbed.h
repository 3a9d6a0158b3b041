// An emulated tracker on a line that is not there: a pty for a serial port, umockdev for USB. A thread lets it measure,
// and carries what it says. Thread-safe.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>

#include "tests/support/tracker_emulator.h"

namespace posed::test {

class TrackerTestbed {
 public:
  virtual ~TrackerTestbed();
  virtual std::string place() const = 0;  // what follows KIND: in the tracker's name: usb, or a path
  virtual void plug() = 0;                // the device keeps what its settings were, as one that stays powered does
  virtual void pull() = 0;                // the cable, out
  virtual bool held() const = 0;          // by a program, at present
  virtual void inject(std::string bytes) = 0;  // into what is read next
  // Everything is carried in pieces of at most so many bytes; 0: as the device says it.
  void carry_in_pieces(std::size_t size) { piece_ = size; }

  void with_tracker(const std::function<void(TrackerEmulator&)>& act);  // under the lock
  template <class Emulator, class Act>
  void with(Act act) {
    with_tracker([&](TrackerEmulator& device) { act(dynamic_cast<Emulator&>(device)); });
  }
  bool streaming();

 protected:
  explicit TrackerTestbed(std::unique_ptr<TrackerEmulator> device) : device_(std::move(device)) {}
  void begin();  // the thread; last in the constructor of who can carry
  void end();    // first in the destructor
  virtual void carry(const TrackerEmulator::Output& output) = 0;
  virtual bool ready() { return true; }  // to carry: what nobody reads stays in the device
  virtual void listen() {}               // what the host wrote

 private:
  void run();
  void deliver();

  std::mutex mutex_;  // of device_
  std::unique_ptr<TrackerEmulator> device_;
  std::atomic<bool> stopping_{false};
  std::atomic<std::size_t> piece_{0};
  std::thread ticker_;
};

}  // namespace posed::test
