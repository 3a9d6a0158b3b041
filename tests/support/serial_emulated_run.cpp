// serial_emulated_run KIND COMMAND...: runs COMMAND with an emulated tracker at a serial port that is not there. {PORT}
// in its words is the port's path. KIND: liberty, patriot, fastrak, isotrak. Its exit status is COMMAND's; on standard
// error it says "serial: streaming=0" at the end, so that a test can see how the device was left.
//
// Its sensors swing before a figure's hands. Each line on standard input is an act: pose N X Y Z [AZ EL ROLL] (metres
// and degrees, source's frame) holds sensor N there; pivot N X Y Z TX TY TZ swings it about the point X Y Z, where the
// tip of its stylus is (TX TY TZ in its own frame, metres); swing N lets it swing again; button 0|1 (station 1's).
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/support/fastrak_emulator.h"
#include "tests/support/liberty_emulator.h"
#include "tests/support/pty_testbed.h"

namespace {

using posed::test::FastrakEmulator;
using posed::test::LibertyEmulator;
using posed::test::SourcePose;

constexpr double kInch = 0.0254;

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
SourcePose swing(int station, double seconds) {
  const double side = station % 2 == 1 ? 1.0 : -1.0;
  SourcePose pose;
  pose.x = (0.45 + 0.10 * std::sin(0.9 * seconds)) / kInch;
  pose.y = side * (0.25 + 0.20 * std::sin(0.7 * seconds + 1)) / kInch;
  pose.z = -(1.20 + 0.30 * std::sin(0.5 * seconds + 2)) / kInch;
  pose.azimuth = 40 * std::sin(0.6 * seconds);
  return pose;
}

// The stylus leans by half a radian, its other end goes round and it turns about itself. The tip stays.
SourcePose pivot(const std::vector<double>& at, double seconds) {
  SourcePose pose;
  pose.azimuth = 30 * std::sin(3.0 * seconds);
  pose.elevation = 30 * std::cos(3.0 * seconds);
  pose.roll = 40 * std::sin(1.3 * seconds);
  double m[9];
  posed::test::matrix_of(pose, m);
  const auto turned = [&](int row) { return m[3 * row] * at[3] + m[3 * row + 1] * at[4] + m[3 * row + 2] * at[5]; };
  pose.x = (at[0] - turned(0)) / kInch;
  pose.y = (at[1] - turned(1)) / kInch;
  pose.z = (at[2] - turned(2)) / kInch;
  return pose;
}

// What each sensor does, as it was told last.
class Stage {
 public:
  void on(posed::test::PtyTestbed* bed) {  // null: it is gone
    const std::lock_guard lock(bed_mutex_);
    bed_ = bed;
  }
  void act(const std::string& line) {
    std::istringstream words(line);
    std::string word;
    int station = 0;
    words >> word >> station;
    std::vector<double> numbers;
    for (double n; words >> n;) numbers.push_back(n);
    if (word == "button") {
      const std::lock_guard lock(bed_mutex_);
      if (!bed_) return;
      return bed_->with_tracker([&](posed::test::TrackerEmulator& device) {
        if (auto* fastrak = dynamic_cast<FastrakEmulator*>(&device)) fastrak->press_button(station != 0);
        if (auto* liberty = dynamic_cast<LibertyEmulator*>(&device)) liberty->press_button(1, station != 0);
      });
    }
    const std::lock_guard lock(mutex_);
    acts_.erase(station);
    if ((word == "pose" && numbers.size() >= 3) || (word == "pivot" && numbers.size() == 6))
      acts_[station] = {word, numbers};
  }
  SourcePose pose(int station, double seconds) {
    const std::lock_guard lock(mutex_);
    const auto found = acts_.find(station);
    if (found == acts_.end()) return swing(station, seconds);
    const std::vector<double>& n = found->second.second;
    if (found->second.first == "pivot") return pivot(n, seconds);
    SourcePose pose{n[0] / kInch, n[1] / kInch, n[2] / kInch, 0, 0, 0};
    if (n.size() == 6) pose.azimuth = n[3], pose.elevation = n[4], pose.roll = n[5];
    return pose;
  }

 private:
  std::mutex bed_mutex_;
  posed::test::PtyTestbed* bed_ = nullptr;
  std::mutex mutex_;  // of acts_; taken under the device's own
  std::map<int, std::pair<std::string, std::vector<double>>> acts_;
};

pid_t command = 0;

}  // namespace

int main(int argc, char** argv) {
  auto device = argc > 2 ? make(argv[1]) : nullptr;
  if (!device) {
    std::fputs("usage: serial_emulated_run liberty|patriot|fastrak|isotrak COMMAND... (with {PORT} in it)\n", stderr);
    return 2;
  }
  const auto stage = std::make_shared<Stage>();
  device->set_motion([stage, rate = device->rate_hz()](int station, std::uint32_t count) {
    return stage->pose(station, static_cast<double>(count) / rate);
  });
  std::vector<std::string> words(argv + 2, argv + argc);
  std::vector<char*> pointers;
  auto bed = std::make_unique<posed::test::PtyTestbed>(std::move(device));
  bed->plug();
  stage->on(bed.get());
  // It ends with the program.
  std::thread([stage] {
    for (std::string line; std::getline(std::cin, line);) stage->act(line);
  }).detach();
  for (std::string& word : words) {
    const std::size_t at = word.find("{PORT}");
    if (at != std::string::npos) word.replace(at, 6, bed->place());
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
  for (int i = 0; i < 500 && bed->streaming(); ++i) usleep(10'000);
  std::fprintf(stderr, "serial: streaming=%d\n", bed->streaming());
  stage->on(nullptr);
  bed.reset();
  std::fflush(nullptr);
  _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));  // the thread of acts may wait for ever
}
