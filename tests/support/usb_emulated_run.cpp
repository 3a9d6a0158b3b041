// umockdev-wrapper usb_emulated_run [OPTIONS] -- COMMAND...: runs COMMAND with an emulated LIBERTY on its USB bus.
//
//   --stations N   sensors that are plugged in (2)
//   --product HEX  its USB product id (ff20; ff21 is one that waits for its firmware)
//   --unplugged    starts with nothing on the bus
//   --swing        the sensors move as the simulated tracker's do; otherwise they stand still
//
// Each line on standard input is an act: plug, unplug, sensor N, no-sensor N, pose N X Y Z (inches, source frame),
// freeze, thaw, status, quit (ends COMMAND with SIGTERM). SIGUSR1 unplugs, SIGUSR2 plugs in. Its exit status is
// COMMAND's; on standard error it says "usb: streaming=0 claims=1" at the end, so that a test can see how the device
// was left.
#include <fcntl.h>
#include <poll.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>

#include "tests/support/usb_testbed.h"

namespace {

using posed::test::LibertyEmulator;
using posed::test::LibertyPose;
using posed::test::UsbTestbed;

// Before the figure's hands: world x 0.45 m, y -0.25 or 0.25, z 1.2, in the source's inches (Y right, Z down).
LibertyPose swing(int station, std::uint32_t count) {
  const double t = count / 240.0, side = station % 2 == 1 ? 1.0 : -1.0;
  LibertyPose pose;
  pose.x = (0.45 + 0.10 * std::sin(0.9 * t)) / 0.0254;
  pose.y = side * (0.25 + 0.20 * std::sin(0.7 * t + 1)) / 0.0254;
  pose.z = -(1.20 + 0.30 * std::sin(0.5 * t + 2)) / 0.0254;
  pose.azimuth = 40 * std::sin(0.6 * t);
  pose.elevation = 30 * std::sin(0.8 * t);
  pose.roll = 20 * std::sin(0.4 * t);
  return pose;
}

void tell(UsbTestbed& bed) {
  std::fprintf(stderr, "usb: streaming=%d claims=%d\n", bed.ask(&LibertyEmulator::streaming), bed.claims());
}

void act(UsbTestbed& bed, const std::string& line, pid_t child) {
  std::istringstream words(line);
  std::string word;
  int station = 0;
  words >> word >> station;
  if (word == "plug" && !bed.plugged()) bed.plug();
  if (word == "unplug" && bed.plugged()) bed.unplug();
  if (word == "quit") kill(child, SIGTERM);
  if (word == "status") tell(bed);
  bed.with_device([&](LibertyEmulator& device) {
    if (word == "sensor") device.plug_sensor(station);
    if (word == "no-sensor") device.unplug_sensor(station);
    LibertyPose pose;
    if (word == "pose" && words >> pose.x >> pose.y >> pose.z) device.set_pose(station, pose);
    if (word == "freeze" || word == "thaw") device.set_frozen(word == "freeze");
  });
}

int usage() {
  std::fputs(
      "usage: umockdev-wrapper usb_emulated_run [--stations N] [--product HEX] [--unplugged] [--swing] -- COMMAND...\n",
      stderr);
  return 2;
}

// Acts until the child ends; its wait status.
int attend(UsbTestbed& bed, pid_t child, int signals) {
  pollfd ready[2] = {{signals, POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}};
  std::string typed;
  for (;;) {
    poll(ready, 2, -1);
    if (ready[0].revents & POLLIN) {
      signalfd_siginfo info{};
      if (read(signals, &info, sizeof info) != sizeof info) continue;
      if (info.ssi_signo == SIGUSR1 && bed.plugged()) bed.unplug();
      if (info.ssi_signo == SIGUSR2 && !bed.plugged()) bed.plug();
      if (info.ssi_signo == SIGTERM || info.ssi_signo == SIGINT) kill(child, SIGTERM);
      int status = 0;
      if (info.ssi_signo == SIGCHLD && waitpid(child, &status, WNOHANG) == child) return status;
    }
    if (!(ready[1].revents & (POLLIN | POLLHUP | POLLERR))) continue;
    char text[512];
    const ssize_t got = read(STDIN_FILENO, text, sizeof text);
    if (got <= 0) ready[1].fd = -1;
    typed.append(text, got > 0 ? static_cast<std::size_t>(got) : 0);
    for (std::size_t end; (end = typed.find('\n')) != std::string::npos; typed.erase(0, end + 1)) {
      act(bed, typed.substr(0, end), child);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  posed::test::UsbTestbedOptions options;
  bool plugged = true, swings = false;
  int i = 1;
  for (; i < argc && std::strcmp(argv[i], "--") != 0; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--stations" && has_value) {
      options.stations = std::atoi(argv[++i]);
    } else if (word == "--product" && has_value) {
      options.product = static_cast<std::uint16_t>(std::strtoul(argv[++i], nullptr, 16));
    } else if (word == "--unplugged") {
      plugged = false;
    } else if (word == "--swing") {
      swings = true;
    } else {
      return usage();
    }
  }
  if (i + 1 >= argc) return usage();

  // Before any thread starts, so that all of them leave these signals to the descriptor.
  sigset_t mask, before;
  sigemptyset(&mask);
  for (const int number : {SIGCHLD, SIGUSR1, SIGUSR2, SIGTERM, SIGINT}) sigaddset(&mask, number);
  pthread_sigmask(SIG_BLOCK, &mask, &before);
  const int signals = signalfd(-1, &mask, SFD_CLOEXEC);

  std::string reason;
  const auto bed = UsbTestbed::make(options, reason);
  if (!bed) {
    std::fprintf(stderr, "usb_emulated_run: %s\n", reason.c_str());
    return 77;
  }
  if (swings) bed->with_device([](LibertyEmulator& device) { device.set_motion(swing); });
  if (plugged) bed->plug();

  const pid_t child = fork();
  if (child == 0) {
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);  // the lines are ours
    execvp(argv[i + 1], argv + i + 1);
    std::perror(argv[i + 1]);
    _exit(127);
  }
  const int status = attend(*bed, child, signals);
  tell(*bed);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
