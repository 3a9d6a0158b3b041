// bench_tracker [--out FILE] [--seed N] [--quick]: from the driver's read of a sample to its pose on a viewer's socket.
//
// An emulated LIBERTY at a serial port (a pty) sends a sensor at 240 Hz: the line is too slow for two. It leads the
// right hand of the built-in figure, and viewers read its poses. The stamp is the daemon's own, taken where the driver
// gets the bytes; the age ends with the pose's last byte at the viewer, so decoding, calibration, the solve, encoding
// and the fan-out are in it. The floor is a bare epoll loop that sends frames as long to as many viewers and solves
// nothing; its stamp is taken just before it sends. Servers are on one core, device and viewers on another. Floor and
// daemon take turns.
//
// The exit status is not 0 where a bar is missed; with --quick, which measures nothing worth having, that is only said.
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

#include "tests/bench/bench_output.h"
#include "tests/bench/stream/child.h"
#include "tests/bench/stream/contestants.h"
#include "tests/bench/stream/daemon.h"
#include "tests/bench/stream/folder.h"
#include "tests/bench/stream/measures.h"
#include "tests/bench/stream/viewers.h"
#include "tests/bench/verdict.h"
#include "tests/support/liberty_emulator.h"
#include "tests/support/pty_testbed.h"

namespace posed::test {
namespace {

constexpr double kRate = 240.0;

struct Round {
  double p50_us = 0.0, p99_us = 0.0, p999_us = 0.0, delivered = 0.0, frame_bytes = 0.0;
};

double median_of(const std::vector<Round>& rounds, double Round::*field) {
  std::vector<double> values;
  for (const Round& round : rounds) values.push_back(round.*field);
  return median(std::move(values));
}

// Before the figure's right hand (source's inches, Y right, Z down), on a circle of 20 cm.
SourcePose swing(int, std::uint32_t count) {
  const double t = count / kRate;
  SourcePose pose;
  pose.x = (0.45 + 0.1 * std::sin(2.0 * t)) / 0.0254;
  pose.y = (0.25 + 0.1 * std::cos(2.0 * t)) / 0.0254;
  pose.z = -1.2 / 0.0254;
  return pose;
}

Round watch(Viewers& load, int viewers, Nanoseconds span) {
  load.read_until(monotonic_now() + 500 * kMillisecond);
  const Nanoseconds begin = monotonic_now();
  Arrived arrived = load.read_until(begin + span);
  const double seconds = 1e-9 * static_cast<double>(monotonic_now() - begin);
  const double frames = static_cast<double>(std::max<std::uint64_t>(arrived.frames, 1));
  return {arrived.quantile_us(0.5), arrived.quantile_us(0.99), arrived.quantile_us(0.999),
          static_cast<double>(arrived.frames) / (kRate * seconds * viewers),
          static_cast<double>(arrived.bytes) / frames};
}

Round floor_round(int viewers, Nanoseconds span) {
  const Contestant floor = bare_loop();
  const auto child = floor.start(kRate);
  Viewers load(child->port(), floor.framing, floor.subscribe, viewers);
  return watch(load, viewers, span);
}

void wait_for_stream(client::Client& control) {
  std::string state;
  for (int i = 0; i < 1000; ++i) {
    const auto list = control.call<proto::TrackerListResult>(proto::TrackerList{});
    if (!list) throw std::runtime_error(list.error().message);
    if (!list->trackers.empty() && list->trackers[0].state == "streaming") return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  throw std::runtime_error("the emulated tracker does not stream");
}

Round daemon_round(int viewers, Nanoseconds span) {
  auto device = std::make_unique<LibertyEmulator>(1);
  device->set_on_serial(true);
  device->set_motion(swing);
  PtyTestbed bed(std::move(device));
  bed.plug();
  const Folder folder(Folder::kInMemory);
  const auto daemon = start_daemon("liberty:" + bed.place(), folder.path());
  auto control = connect_to_daemon(*daemon);
  for (const auto& [method, params] :
       {std::pair{"goal.set", R"({"id":"hand","at":"right_hand","position":[0.4,-0.3,1.2]})"},
        std::pair{"binding.set", R"({"sensor":"liberty:1","to":{"goal":"hand"}})"}}) {
    if (const auto done = control.call(method, params); !done) throw std::runtime_error(done.error().message);
  }
  wait_for_stream(control);
  proto::StreamSubscribe wish;
  wish.fields = {"world_from_segment"};  // what the floor sends, too
  Viewers load(daemon->port(), Framing::lines, proto::encode_request(1, wish), viewers);
  load.set_clock_offset(clock_offset(control));
  return watch(load, viewers, span);
}

void tell(BenchOutput& out, const char* who, int viewers, const std::vector<Round>& rounds, double ratio) {
  const double p50 = median_of(rounds, &Round::p50_us), p99 = median_of(rounds, &Round::p99_us);
  const double p999 = median_of(rounds, &Round::p999_us), delivered = median_of(rounds, &Round::delivered);
  const double bytes = median_of(rounds, &Round::frame_bytes);
  std::printf("   %-16s %8d %9.0f %9.0f %9.0f %8.2f %9.2f%% %8.0f\n", who, viewers, p50, p99, p999, ratio,
              100.0 * delivered, bytes);
  out.row(
      R"({"bench":"tracker","case":"sample to pose, %d viewers","who":"%s","viewers":%d,"rate_hz":240,"median_us":%.1f,"p99_us":%.1f,"p999_us":%.1f,"ratio_floor":%.3f,"ok":%.4f,"frame_bytes":%.0f,"rounds":%zu})",
      viewers, who, viewers, p50, p99, p999, ratio, delivered, bytes, rounds.size());
}

void sample_to_pose(BenchOutput& out, Verdict& verdict, int viewers) {
  const int count = out.quick() ? 1 : kRounds;
  const Nanoseconds span = out.quick() ? kSecond / 2 : 3 * kSecond;
  std::vector<Round> floor, posed;
  std::vector<double> ratios;
  for (int i = 0; i < count; ++i) {
    floor.push_back(floor_round(viewers, span));  // first: it forks, and wants this process to have one thread
    posed.push_back(daemon_round(viewers, span));
    ratios.push_back(posed.back().p99_us / floor.back().p99_us);
  }
  const double ratio = median(ratios), p99 = median_of(posed, &Round::p99_us);
  tell(out, "floor", viewers, floor, 1.0);
  tell(out, "posed/springs", viewers, posed, ratio);
  const double delivered = median_of(posed, &Round::delivered);
  verdict.judge(delivered >= 0.97, "%.1f%% of the poses come, at least %.0f%%", 100.0 * delivered, 97.0);
  if (viewers == 1) {
    verdict.judge(p99 < 1000.0, "p99 %.0f us with one viewer, under %.0f", p99, 1000.0);
  } else {
    verdict.judge(ratio <= 2.0, "p99 is %.2f times the floor's, at most %.1f", ratio, 2.0);
  }
}

}  // namespace
}  // namespace posed::test

int main(int argc, char** argv) try {
  using namespace posed::test;
  BenchOutput out(argc, argv);
  if (std::thread::hardware_concurrency() < 2 || !pin_to_core(kLoadCore))
    std::printf("one core for servers and load: ages mean little\n");
  if (out.quick()) std::printf("--quick: short, and once instead of nine times; the figures mean nothing\n");
  Verdict verdict;
  std::printf("from the driver's read to the pose at a viewer, an emulated LIBERTY at 240 Hz leads a hand of tempus\n");
  std::printf("   %-16s %8s %9s %9s %9s %8s %10s %8s\n", "who", "viewers", "p50_us", "p99_us", "p99.9_us", "x floor",
              "delivered", "frame_B");
  for (const int viewers : {1, 100}) sample_to_pose(out, verdict, viewers);
  std::printf("\n%d bars held, %d missed\n", verdict.held, verdict.missed);
  return verdict.missed > 0 && !out.quick() ? 1 : 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_tracker: %s\n", e.what());
  return 1;
}
