// A serial port that is not there: a pty behind a path of its own, with an emulated tracker at its far end. A pty has
// no baud rate and no modem lines; all else is the kernel's own terminal.
#pragma once

#include "tests/support/tracker_testbed.h"

namespace posed::test {

class PtyTestbed final : public TrackerTestbed {
 public:
  explicit PtyTestbed(std::unique_ptr<TrackerEmulator> device);
  ~PtyTestbed() override;

  std::string place() const override { return path_; }
  std::string node() const;  // the pty's own name, to which path_ links
  void plug() override;
  void pull() override;
  bool held() const override;
  void inject(std::string bytes) override;

 private:
  void carry(const TrackerEmulator::Output& output) override;
  void listen() override;

  std::string folder_, path_;
  mutable std::mutex mutex_;  // of master_ and node_
  int master_ = -1;
  std::string node_;
};

}  // namespace posed::test
