// print_tracker SPEC [FRAMES]: what a tracker says, as lines; ends after FRAMES frames, or on SIGTERM.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <unistd.h>

#include "common/time.h"
#include "server/tracker/registry.h"

namespace {

const char* name_of(posed::tracker::State state) {
  static const char* const kNames[] = {"searching", "starting", "streaming", "silent", "failed"};
  return kNames[static_cast<int>(state)];
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fputs("usage: print_tracker SPEC [FRAMES]\n", stderr), 2;
  const long wanted = argc > 2 ? std::atol(argv[2]) : -1;
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGTERM);
  sigaddset(&ends, SIGINT);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);  // the tracker's thread inherits this

  const posed::Clock clock;
  auto tracker = posed::tracker::make_tracker(argv[1], [&clock] { return clock.now(); });
  if (!tracker) return std::fprintf(stderr, "%s\n", tracker.error().message.c_str()), 2;
  long frames = 0;
  posed::tracker::Sink sink;
  sink.frame = [&](const posed::Frame& frame) {
    for (const posed::Sample& s : frame.samples) {
      std::printf("%.6f %s:%d %.4f %.4f %.4f  %.4f %.4f %.4f %.4f %u\n", static_cast<double>(frame.t_ns) * 1e-9,
                  frame.device.c_str(), s.station, s.position.x, s.position.y, s.position.z, s.rotation.x, s.rotation.y,
                  s.rotation.z, s.rotation.w, s.device_count);
    }
    if (++frames == wanted) kill(getpid(), SIGTERM);
  };
  sink.status = [](const posed::tracker::Status& status) {
    std::printf("%s %s\n", name_of(status.state), status.message.c_str());
    std::fflush(stdout);
  };
  (*tracker)->start(std::move(sink));
  int number = 0;
  sigwait(&ends, &number);
  (*tracker)->stop();
}
