// bench_stream [--out FILE] [--seed N] [--quick]: streams under load, side by side with a bare epoll loop that sends as
// many bytes ("floor") and with brokers that are in Debian. Every server is a process of its own with all its threads
// on one core, the load is on another one. CPU time is that of the server alone; age is from a frame's stamp, just
// before it is handed to the fan-out, to its last byte at the viewer. Everyone takes part in every round, and ratios
// are between figures of one round: what else runs on the machine disturbs all alike.
//
// The exit status is not 0 where a bar is missed; with --quick, which measures nothing worth having, that is only said.
#include <sys/resource.h>

#include <cstdio>
#include <exception>
#include <thread>

#include "tests/bench/stream/cases.h"
#include "tests/bench/stream/child.h"

int main(int argc, char** argv) try {
  using namespace posed::test;
  BenchOutput out(argc, argv);
  rlimit files{};
  getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  setrlimit(RLIMIT_NOFILE, &files);
  if (std::thread::hardware_concurrency() < 2 || !pin_to_core(kLoadCore))
    std::printf("one core for servers and load: ages mean little\n");
  if (out.quick()) std::printf("--quick: short, and once instead of nine times; the figures mean nothing\n");

  Verdict verdict;
  fan_out(out, verdict, 100, 240.0);
  fan_out(out, verdict, 1000, 60.0);
  fan_out(out, verdict, 1000, 240.0);
  std::printf(
      "\nthe whole daemon with its solver and a sensor that drags a hand at 240 Hz; ages from the sample's arrival\n");
  std::printf("   %-16s %8s %12s %9s %9s %10s\n", "who", "viewers", "of a core", "p50_us", "p99_us", "delivered");
  for (const int viewers : {1, 10, 100}) whole_daemon(out, viewers);
  memory(out, verdict);
  many_connections(out, verdict);
  pings(out, verdict);
  editors_and_viewers(out, verdict);
  durable_edits(out);
  stalled_viewer(out, verdict);
  std::printf("\n%d bars held, %d missed\n", verdict.held, verdict.missed);
  return verdict.missed > 0 && !out.quick() ? 1 : 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_stream: %s\n", e.what());
  return 1;
}
