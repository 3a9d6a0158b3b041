// A tracker that runs, and what it has said. Waits are for events, with generous limits.
#pragma once

#include <chrono>
#include <concepts>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "common/time.h"
#include "server/tracker/registry.h"
#include "server/tracker/tracker.h"

namespace posed::test {

class WatchedTracker {
 public:
  // `make` gets the clock to give to the tracker.
  template <class Make>
  requires std::invocable<Make, tracker::TimeSource>
  explicit WatchedTracker(Make make) : tracker_(make([this] { return clock_.now(); })) {
    tracker_->start({[this](Frame frame) {
                       const std::lock_guard lock(mutex_);
                       frames_.push_back(std::move(frame));
                       wake_.notify_all();
                     },
                     [this](const tracker::Status& status) {
                       const std::lock_guard lock(mutex_);
                       status_ = status;
                       wake_.notify_all();
                     }});
  }

  // As --tracker has it: "liberty:usb".
  explicit WatchedTracker(const std::string& spec)
      : WatchedTracker(
            [&](tracker::TimeSource now) { return std::move(*tracker::make_tracker(spec, std::move(now))); }) {}

  template <class Condition>
  bool wait(Condition condition) {
    std::unique_lock lock(mutex_);
    return wake_.wait_for(lock, std::chrono::seconds(40), condition);
  }
  bool wait_for_frames(std::size_t more) {
    std::size_t wanted = 0;
    {
      const std::lock_guard lock(mutex_);
      wanted = frames_.size() + more;
    }
    return wait([&] { return frames_.size() >= wanted; });
  }
  // The last frame fits.
  template <class Fits>
  bool wait_for_frame(Fits fits) {
    return wait([&] { return !frames_.empty() && fits(frames_.back()); });
  }
  bool wait_for_state(tracker::State state) {
    return wait([&] { return status_.state == state; });
  }
  bool wait_for_message(const std::string& part) {
    return wait([&] { return status_.message.find(part) != std::string::npos; });
  }
  bool wait_for_stations(std::size_t count) {
    return wait_for_frame([&](const Frame& frame) { return frame.samples.size() == count; });
  }
  std::vector<Frame> frames() {
    const std::lock_guard lock(mutex_);
    return frames_;
  }
  tracker::Status status() {
    const std::lock_guard lock(mutex_);
    return status_;
  }
  // Inside a wait's condition.
  const tracker::Status& last_status() const { return status_; }
  const std::vector<Frame>& last_frames() const { return frames_; }
  Result<Ok> configure(const tracker::Settings& settings) { return tracker_->configure(settings); }
  void stop() { tracker_->stop(); }

 private:
  Clock clock_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Frame> frames_;
  tracker::Status status_;
  std::unique_ptr<tracker::Tracker> tracker_;
};

}  // namespace posed::test
