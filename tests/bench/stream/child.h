// A server in a process of its own, all its threads on one core. The process ends with this object, or with ours.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "common/time.h"

namespace posed::test {

inline constexpr int kServerCore = 0, kLoadCore = 1;

// Absolute, on CLOCK_MONOTONIC: the same in all processes.
Nanoseconds monotonic_now();
// The calling thread, and those that it starts from then on. False where there is no such core.
bool pin_to_core(int core);
std::uint16_t free_port();

class Child {
 public:
  // Forks: `serve` tells its port by the function that it is given, and runs until the process is ended. Call it while
  // this process has one thread.
  explicit Child(const std::function<void(const std::function<void(std::uint16_t)>& tell_port)>& serve);
  // Starts a program that will listen at `port`, and waits until it does.
  Child(const std::vector<std::string>& command, std::uint16_t port);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::uint16_t port() const { return port_; }
  Nanoseconds cpu_ns() const;          // of all its threads so far
  std::size_t resident_bytes() const;  // of memory that is its own

 private:
  pid_t pid_ = -1;
  std::uint16_t port_ = 0;
};

}  // namespace posed::test
