#include "client/cli/view/terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

namespace posed::view {
namespace {

// The alternate screen; no cursor; no new line behind the last column. And back, with synchronized output ended first:
// a frame may have been cut off.
constexpr std::string_view kEnter = "\x1b[?1049h\x1b[?25l\x1b[?7l";
constexpr std::string_view kLeave = "\x1b[?2026l\x1b[0m\x1b[?7h\x1b[?25h\x1b[?1049l";

// For the handler of crashes, too, which can see nothing else.
termios before;
volatile std::sig_atomic_t held = 0;

void put_back() {
  if (!held) return;
  held = 0;
  [[maybe_unused]] const auto sent = ::write(STDOUT_FILENO, kLeave.data(), kLeave.size());
  ::tcsetattr(STDIN_FILENO, TCSANOW, &before);
}

void crashed(int signal) {
  put_back();
  ::raise(signal);  // its action is the default one again
}

sigset_t ours() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGCONT, SIGWINCH}) sigaddset(&set, signal);
  return set;
}

Error gone() {
  return {"end_of_input", "the terminal is gone", "", ""};
}

}  // namespace

Result<std::unique_ptr<Terminal>> Terminal::take() {
  if (!::isatty(STDIN_FILENO) || !::isatty(STDOUT_FILENO) || ::tcgetattr(STDIN_FILENO, &before) != 0)
    return Error{"no_terminal", "view draws on a terminal, and this is none", "",
                 "posectl watch writes lines for programs; posectl view --once prints one picture"};
  std::unique_ptr<Terminal> terminal(new Terminal);
  // Opened anew, since whether a write waits belongs to what was opened, and that is our shell's, too.
  std::array<char, 256> name{};
  if (::ttyname_r(STDOUT_FILENO, name.data(), name.size()) == 0)
    terminal->output_ = ::open(name.data(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  terminal->own_output_ = terminal->output_ >= 0;
  if (!terminal->own_output_) terminal->output_ = STDOUT_FILENO;

  const sigset_t set = ours();
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  terminal->signals_ = ::signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC);
  if (terminal->signals_ < 0) return Error{"internal", "no descriptor for signals", "", "are too many files open?"};
  struct sigaction action {};
  action.sa_handler = crashed;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::sigaction(signal, &action, nullptr);
  terminal->hold();
  return terminal;
}

Terminal::~Terminal() {
  let_go();
  if (signals_ >= 0) ::close(signals_);
  if (own_output_) ::close(output_);
}

void Terminal::hold() {
  termios raw = before;
  ::cfmakeraw(&raw);
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  ::tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  held = 1;
  owed_.clear();
  [[maybe_unused]] const Status sent = write(kEnter);
}

void Terminal::let_go() {
  if (!held) return;
  // What was owed ends somewhere within a sequence; a cancel ends it for the terminal, too.
  if (!owed_.empty()) [[maybe_unused]]
    const auto sent = ::write(output_, "\x18", 1);
  owed_.clear();
  put_back();
}

Size Terminal::size() const {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return {};
  return {size.ws_col, size.ws_row};
}

int Terminal::input() const {
  return STDIN_FILENO;
}

Result<std::string> Terminal::read() {
  std::array<char, 4096> bytes{};
  const ssize_t got = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  if (got > 0) return std::string(bytes.data(), static_cast<std::size_t>(got));
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return std::string();
  if (got < 0) return gone();
  // Nothing there, or hung up: poll knows.
  pollfd poll{STDIN_FILENO, POLLIN, 0};
  ::poll(&poll, 1, 0);
  if ((poll.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) return gone();
  return std::string();
}

int Terminal::next_signal() {
  signalfd_siginfo info{};
  return ::read(signals_, &info, sizeof info) == sizeof info ? static_cast<int>(info.ssi_signo) : 0;
}

Status Terminal::write(std::string_view bytes) {
  owed_ += bytes;
  return flush();
}

Status Terminal::flush() {
  while (!owed_.empty()) {
    const ssize_t sent = ::write(output_, owed_.data(), owed_.size());
    if (sent >= 0) {
      owed_.erase(0, static_cast<std::size_t>(sent));
    } else if (errno != EINTR) {
      if (errno == EAGAIN) return Ok{};
      return gone();
    }
  }
  return Ok{};
}

void Terminal::suspend() {
  let_go();
  // The default action, so that the kernel lets us live on where nobody could wake us.
  sigset_t stop;
  sigemptyset(&stop);
  sigaddset(&stop, SIGTSTP);
  ::kill(::getpid(), SIGTSTP);
  ::pthread_sigmask(SIG_UNBLOCK, &stop, nullptr);
  ::pthread_sigmask(SIG_BLOCK, &stop, nullptr);
  hold();
}

void Terminal::drop_input() {
  ::tcflush(STDIN_FILENO, TCIFLUSH);
}

}  // namespace posed::view
