#include "tests/support/pty_testbed.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace posed::test {

PtyTestbed::PtyTestbed(std::unique_ptr<TrackerEmulator> device) : TrackerTestbed(std::move(device)) {
  std::string pattern = std::filesystem::temp_directory_path() / "serial-XXXXXX";
  if (!::mkdtemp(pattern.data())) throw std::runtime_error("no folder for a serial port");
  folder_ = pattern;
  path_ = folder_ + "/ttyUSB0";
  begin();
}

PtyTestbed::~PtyTestbed() {
  end();
  if (master_ >= 0) pull();
  std::filesystem::remove_all(folder_);
}

void PtyTestbed::plug() {
  int master = -1, slave = -1;
  char name[64] = {};
  if (::openpty(&master, &slave, name, nullptr, nullptr) != 0) throw std::runtime_error("no pty");
  // Nothing echoes on a serial line. The setting stays while the master is open.
  termios settings{};
  ::tcgetattr(slave, &settings);
  ::cfmakeraw(&settings);
  ::tcsetattr(slave, TCSANOW, &settings);
  ::close(slave);
  ::fcntl(master, F_SETFL, O_NONBLOCK);
  ::fcntl(master, F_SETFD, FD_CLOEXEC);
  const std::lock_guard lock(mutex_);
  master_ = master;
  node_ = name;
  std::filesystem::create_symlink(node_, path_);
}

void PtyTestbed::pull() {
  const std::lock_guard lock(mutex_);
  std::filesystem::remove(path_);
  ::close(master_);
  master_ = -1;
}

std::string PtyTestbed::node() const {
  const std::lock_guard lock(mutex_);
  return node_;
}

// A master hears a hang-up where nobody has the slave open.
bool PtyTestbed::held() const {
  const std::lock_guard lock(mutex_);
  pollfd master{master_, POLLIN, 0};
  return master_ >= 0 && ::poll(&master, 1, 0) >= 0 && (master.revents & POLLHUP) == 0;
}

void PtyTestbed::inject(std::string bytes) {
  carry({{bytes.begin(), bytes.end()}, false});
}

// What does not fit is lost, as on a line that nobody listens to.
void PtyTestbed::carry(const TrackerEmulator::Output& output) {
  const std::lock_guard lock(mutex_);
  if (master_ < 0) return;
  [[maybe_unused]] const auto written = ::write(master_, output.bytes.data(), output.bytes.size());
}

void PtyTestbed::listen() {
  std::vector<std::uint8_t> heard(512);
  {
    const std::lock_guard lock(mutex_);
    if (master_ < 0) return;
    const ssize_t size = ::read(master_, heard.data(), heard.size());
    heard.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  }
  if (!heard.empty()) with_tracker([&](TrackerEmulator& device) { device.write(heard); });
}

}  // namespace posed::test
