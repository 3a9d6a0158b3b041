// A capture as a tracker: its Frames, by the same decoder, under the id that they had.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "server/tracker/capture/reader.h"
#include "server/tracker/time_source.h"
#include "server/tracker/tracker.h"

namespace posed::tracker {

class ReplayTracker final : public Tracker {
 public:
  // `flat_out`: without waiting. Either way the Frames' times are those of the capture, counted from the start.
  ReplayTracker(CaptureReader reader, bool flat_out, TimeSource now);
  ~ReplayTracker() override;

  const std::string& id() const override { return reader_.device(); }
  const std::string& kind() const override;
  void start(Sink sink) override;
  void stop() override;

 private:
  void run(Sink sink);
  bool wait_until(Nanoseconds t_ns);  // false: stopping

  CaptureReader reader_;
  bool flat_out_;
  TimeSource now_;
  std::mutex mutex_;  // of stopping_
  std::condition_variable wake_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace posed::tracker
