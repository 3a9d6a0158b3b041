// serial_emulated_run KIND COMMAND...: runs COMMAND with an emulated tracker at a serial port that is not there. {PORT}
// in its words is the port's path. KIND: liberty, patriot, fastrak, isotrak. Its exit status is COMMAND's; on standard
// error it says "serial: streaming=0" at the end, so that a test can see how the device was left.
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/fastrak_emulator.h"
#include "tests/support/liberty_emulator.h"
#include "tests/support/pty_testbed.h"

namespace {

using posed::test::FastrakEmulator;
using posed::test::LibertyEmulator;

std::unique_ptr<posed::test::TrackerEmulator> make(std::string_view kind) {
  if (kind == "fastrak") return std::make_unique<FastrakEmulator>(2);
  if (kind == "isotrak") return std::make_unique<FastrakEmulator>(2, FastrakEmulator::Kind::isotrak);
  std::unique_ptr<LibertyEmulator> device;
  if (kind == "liberty") device = std::make_unique<LibertyEmulator>(2);
  if (kind == "patriot") device = std::make_unique<LibertyEmulator>(2, posed::test::kPatriotKind);
  if (device) device->set_on_serial(true);
  return device;
}

// Before the figure's hands: world x 0.45 m, y -0.25 or 0.25, z 1.2, in the source's inches (Y right, Z down).
posed::test::SourcePose swing(int station, double seconds) {
  const double side = station % 2 == 1 ? 1.0 : -1.0;
  posed::test::SourcePose pose;
  pose.x = (0.45 + 0.10 * std::sin(0.9 * seconds)) / 0.0254;
  pose.y = side * (0.25 + 0.20 * std::sin(0.7 * seconds + 1)) / 0.0254;
  pose.z = -(1.20 + 0.30 * std::sin(0.5 * seconds + 2)) / 0.0254;
  pose.azimuth = 40 * std::sin(0.6 * seconds);
  return pose;
}

pid_t command = 0;

}  // namespace

int main(int argc, char** argv) {
  auto device = argc > 2 ? make(argv[1]) : nullptr;
  if (!device) {
    std::fputs("usage: serial_emulated_run liberty|patriot|fastrak|isotrak COMMAND... (with {PORT} in it)\n", stderr);
    return 2;
  }
  device->set_motion([rate = device->rate_hz()](int station, std::uint32_t count) {
    return swing(station, static_cast<double>(count) / rate);
  });
  std::vector<std::string> words(argv + 2, argv + argc);
  std::vector<char*> pointers;
  posed::test::PtyTestbed bed(std::move(device));
  bed.plug();
  for (std::string& word : words) {
    const std::size_t at = word.find("{PORT}");
    if (at != std::string::npos) word.replace(at, 6, bed.place());
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);

  command = fork();
  if (command == 0) {
    execvp(pointers[0], pointers.data());
    std::perror(pointers[0]);
    _exit(127);
  }
  for (const int number : {SIGTERM, SIGINT}) signal(number, [](int sent) { kill(command, sent); });
  int status = 0;
  while (waitpid(command, &status, 0) < 0) continue;
  // The last that it was told may still be on its way.
  for (int i = 0; i < 500 && bed.streaming(); ++i) usleep(10'000);
  std::fprintf(stderr, "serial: streaming=%d\n", bed.streaming());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
