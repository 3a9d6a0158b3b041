// What other threads want of the network loop, in order.
#pragma once

#include <mutex>
#include <vector>

namespace posed::net {

template <class Command>
class Mailbox {
 public:
  // True if it was empty: the reader has to be woken.
  bool push(Command command) {
    const std::lock_guard lock(mutex_);
    commands_.push_back(std::move(command));
    return commands_.size() == 1;
  }

  // All that is there. `into` gives its memory for the next ones.
  void take(std::vector<Command>& into) {
    into.clear();
    const std::lock_guard lock(mutex_);
    commands_.swap(into);
  }

 private:
  std::mutex mutex_;
  std::vector<Command> commands_;
};

}  // namespace posed::net
