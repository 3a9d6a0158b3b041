// Instructions that this thread executes in user space: by the processor's own counter (Linux: perf_event_open; many
// containers refuse it), or one step after the other, which is slow and works anywhere.
#pragma once

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <functional>

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

// Of `work`, done in a child process that is stepped through: 10 to 20 us an instruction. 0 where even that is refused.
inline double count_by_steps(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
    raise(SIGUSR1);
    work();
    raise(SIGUSR2);
    _exit(0);
  }
  double count = 0.0;
  bool inside = false;
  for (int status = 0; child > 0 && waitpid(child, &status, 0) == child && WIFSTOPPED(status);) {
    const int signal = WSTOPSIG(status);
    if (signal == SIGUSR2) break;
    if (signal == SIGUSR1) inside = true;
    if (signal == SIGTRAP && inside) ++count;
    if (ptrace(inside ? PTRACE_SINGLESTEP : PTRACE_CONT, child, nullptr, nullptr) != 0) break;
  }
  if (child > 0) {
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  return count;
}

}  // namespace posed::test
