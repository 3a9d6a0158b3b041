// The terminal itself: raw while it is held, as it was before when it is let go, whatever ends the program. One at a
// time. Signals come as values, by a descriptor.
#pragma once

#include <termios.h>

#include <memory>
#include <string>
#include <string_view>

#include "client/cli/view/cell.h"
#include "common/result.h"

namespace posed::view {

class Terminal {
 public:
  // Standard input and output must be terminals ("no_terminal"). Takes the terminal. From now on SIGINT, SIGTERM,
  // SIGHUP, SIGQUIT, SIGTSTP, SIGCONT and SIGWINCH come by signals(), in this thread and those that it makes.
  static Result<std::unique_ptr<Terminal>> take();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  Size size() const;
  int input() const;  // to be polled
  int output() const { return output_; }
  int signals() const { return signals_; }

  // The bytes that are there. "end_of_input" when the terminal is gone.
  Result<std::string> read();
  // The next signal, or 0.
  int next_signal();

  // Sends as much as the terminal takes now, and keeps the rest for flush(). "end_of_input" when the terminal is gone.
  Status write(std::string_view bytes);
  Status flush();
  bool owes() const { return !owed_.empty(); }

  // Stops the program, as Ctrl-Z does elsewhere; returns when it goes on, with the terminal held again.
  void suspend();
  // After a stop that nobody asked us about: whatever the shell has done meanwhile, it is ours again.
  void hold();
  void let_go();
  // Throws away what was typed and not read.
  void drop_input();

 private:
  Terminal() = default;
  int output_ = -1, signals_ = -1;
  bool own_output_ = false;
  std::string owed_;
};

}  // namespace posed::view
