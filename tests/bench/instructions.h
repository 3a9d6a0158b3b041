// Instructions that this thread executes in user space, where the machine lets a program count them (Linux:
// perf_event_open; many containers refuse it).
#pragma once

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace posed::test {

class Instructions {
 public:
  Instructions() {
    perf_event_attr what{};
    what.size = sizeof what;
    what.type = PERF_TYPE_HARDWARE;
    what.config = PERF_COUNT_HW_INSTRUCTIONS;
    what.exclude_kernel = what.exclude_hv = 1;
    file_ = static_cast<int>(syscall(SYS_perf_event_open, &what, 0, -1, -1, 0));
  }
  ~Instructions() {
    if (counts()) close(file_);
  }
  Instructions(const Instructions&) = delete;
  Instructions& operator=(const Instructions&) = delete;

  bool counts() const { return file_ >= 0; }
  // So far; 0 where they can not be counted.
  double now() const {
    std::uint64_t count = 0;
    if (!counts() || read(file_, &count, sizeof count) != sizeof count) return 0.0;
    return static_cast<double>(count);
  }

 private:
  int file_ = -1;
};

}  // namespace posed::test
