#include "tests/bench/stream/cases.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "tests/bench/stream/contestants.h"
#include "tests/bench/stream/daemon.h"
#include "tests/bench/stream/folder.h"
#include "tests/bench/stream/measures.h"
#include "tests/bench/stream/viewers.h"

namespace posed::test {
namespace {

// The newest frame is up to a tick old when a viewer wakes.
constexpr Nanoseconds kFresh = 10 * kMillisecond;

// With so many requests under way all the time.
double ping_rate(std::uint16_t port, int depth, Nanoseconds span) {
  const int fd = connect_to(port);
  const std::string ping = proto::encode_request(1, proto::SessionPing{}) + "\n";
  std::string many;
  for (int i = 0; i < depth; ++i) many += ping;
  std::vector<char> buffer(64 << 10);
  std::uint64_t answered = 0;
  const Nanoseconds begin = monotonic_now();
  for (std::size_t wanted = static_cast<std::size_t>(depth); monotonic_now() - begin < span;) {
    send_all(fd, std::string_view(many).substr(0, wanted * ping.size()));
    const ssize_t got = recv(fd, buffer.data(), buffer.size(), 0);
    if (got <= 0) throw std::runtime_error("the daemon has closed the connection");
    wanted = static_cast<std::size_t>(std::count(buffer.data(), buffer.data() + got, '\n'));
    answered += wanted;
  }
  const double seconds = 1e-9 * static_cast<double>(monotonic_now() - begin);
  close(fd);
  return static_cast<double>(answered) / seconds;
}

}  // namespace

void whole_daemon(BenchOutput& out, int viewers) {
  const Folder folder;
  const auto daemon = start_daemon("simulated:" + std::to_string(out.seed()), folder.path());
  auto control = connect_to_daemon(*daemon);
  for (const auto& [method, params] :
       {std::pair{"goal.set", R"({"id":"hand","at":"right_hand","position":[0.4,-0.3,1.2]})"},
        std::pair{"binding.set", R"({"sensor":"simulated:1","to":{"goal":"hand"}})"}}) {
    if (const auto done = control.call(method, params); !done) throw std::runtime_error(done.error().message);
  }
  Viewers load(daemon->port(), Framing::lines, proto::encode_request(1, proto::StreamSubscribe{}), viewers);
  load.set_clock_offset(clock_offset(control));
  load.read_until(monotonic_now() + 500 * kMillisecond);
  const Nanoseconds begin = monotonic_now(), cpu = daemon->cpu_ns();
  Arrived arrived = load.read_until(begin + (out.quick() ? kSecond / 2 : 5 * kSecond));
  const double used = 1e-9 * static_cast<double>(daemon->cpu_ns() - cpu);
  const double seconds = 1e-9 * static_cast<double>(monotonic_now() - begin);
  const double frames = static_cast<double>(arrived.frames), delivered = frames / (240.0 * seconds * viewers);
  const double p50 = arrived.quantile_us(0.5), p99 = arrived.quantile_us(0.99);
  std::printf("   %-16s %8d %11.1f%% %9.0f %9.0f %9.2f%%\n", "posed", viewers, 100.0 * used / seconds, p50, p99,
              100.0 * delivered);
  out.row(
      R"({"bench":"stream","case":"daemon %d x 240 Hz","who":"posed/springs","viewers":%d,"rate_hz":240,"core_percent":%.2f,"median_us":%.1f,"p99_us":%.1f,"ok":%.4f})",
      viewers, viewers, 100.0 * used / seconds, p50, p99, delivered);
}

void memory(BenchOutput& out, Verdict& verdict) {
  const int viewers = 1000;
  std::string missing;
  std::vector<Contestant> all{bare_loop(), posed_lines(), posed_websocket()};
  for (Contestant& broker : brokers(missing)) all.push_back(std::move(broker));
  std::printf("\nmemory of the server's own a viewer, with %d of them at 60 Hz\n", viewers);
  for (const Contestant& who : all) {
    const auto child = who.start(60.0);
    const std::size_t before = child->resident_bytes();
    Viewers load(child->port(), who.framing, who.subscribe, viewers);
    std::uint64_t seq = 0;
    if (who.broker) load.publish(60.0, [&seq](Nanoseconds stamp) { return pose_frame(++seq, stamp); });
    load.read_until(monotonic_now() + (out.quick() ? kSecond / 2 : 2 * kSecond));
    const double bytes = static_cast<double>(child->resident_bytes() - before) / viewers;
    std::printf("   %-16s %8.0f bytes\n", who.who.c_str(), bytes);
    out.row(R"({"bench":"stream","case":"memory","who":"%s","viewers":%d,"bytes_per_viewer":%.0f})", who.who.c_str(),
            viewers, bytes);
    if (who.who == "posed/tcp") verdict.judge(bytes <= 3072, "TCP keeps %.0f bytes, at most %.0f", bytes, 3072);
    if (who.who == "posed/websocket")
      verdict.judge(bytes <= 8192, "WebSocket keeps %.0f bytes, at most %.0f", bytes, 8192);
  }
}

void many_connections(BenchOutput& out, Verdict& verdict) {
  const int viewers = out.quick() ? 500 : 5000;
  std::printf("\n%d connections held at 10 Hz\n", viewers);
  for (const Contestant& who : {posed_lines(), posed_websocket()}) {
    const auto child = who.start(10.0);
    const Nanoseconds before = monotonic_now();
    Viewers load(child->port(), who.framing, who.subscribe, viewers);
    const double connect_us = 1e-3 * static_cast<double>(monotonic_now() - before) / viewers;
    load.read_until(monotonic_now() + kSecond);
    const Nanoseconds begin = monotonic_now();
    Arrived arrived = load.read_until(begin + (out.quick() ? kSecond : 5 * kSecond));
    const double seconds = 1e-9 * static_cast<double>(monotonic_now() - begin);
    const double delivered = static_cast<double>(arrived.frames) / (10.0 * seconds * viewers);
    std::printf("   %-16s %d closed, %.2f%% delivered, p99 %.0f us, %.0f us to connect one\n", who.who.c_str(),
                load.closed(), 100.0 * delivered, arrived.quantile_us(0.99), connect_us);
    out.row(
        R"({"bench":"stream","case":"held","who":"%s","viewers":%d,"closed":%d,"ok":%.4f,"p99_us":%.1f,"connect_us":%.1f})",
        who.who.c_str(), viewers, load.closed(), delivered, arrived.quantile_us(0.99), connect_us);
    verdict.judge(load.closed() == 0, "%.0f connections were closed, at most %.0f", load.closed(), 0);
  }
}

void pings(BenchOutput& out, Verdict& verdict) {
  const Folder folder;
  const auto daemon = start_daemon("simulated:" + std::to_string(out.seed()), folder.path());
  std::printf("\nsession.ping of the whole daemon, on one connection\n");
  for (const int depth : {1, 32}) {
    std::vector<double> rates;
    for (int i = 0; i < (out.quick() ? 1 : kRounds); ++i) {
      rates.push_back(ping_rate(daemon->port(), depth, out.quick() ? 200 * kMillisecond : kSecond / 2));
    }
    const double rate = median(rates);
    std::printf("   %2d under way      %.0f a second\n", depth, rate);
    out.row(R"({"bench":"stream","case":"ping depth %d","who":"posed","calls_per_s":%.0f,"rounds":%zu})", depth, rate,
            rates.size());
    if (depth > 1) verdict.judge(rate >= 40'000, "%.0f pings a second, at least %.0f", rate, 40'000);
  }
}

void stalled_viewer(BenchOutput& out, Verdict& verdict) {
  const int viewers = 100;
  const Nanoseconds stall = out.quick() ? kSecond : 10 * kSecond;
  std::printf("\none of %d viewers stops reading for %lld s at 240 Hz\n", viewers,
              static_cast<long long>(stall / kSecond));
  for (const Contestant& who : {posed_lines(), posed_websocket()}) {
    const auto child = who.start(240.0);
    Viewers load(child->port(), who.framing, who.subscribe, viewers, subscribe_line(3));
    load.acknowledge();
    load.read_until(monotonic_now() + kSecond);
    Arrived before = load.read_until(monotonic_now() + stall / 2, 0);
    load.stall(true);
    Arrived during = load.read_until(monotonic_now() + stall, 0);
    load.stale_frames(0);
    const Nanoseconds woken = monotonic_now();
    load.stall(false);
    Arrived after = load.read_until(monotonic_now() + stall / 2, 0);
    const int stale = load.stale_frames(woken - kFresh);
    const double p99_before = before.quantile_us(0.99), p99_during = during.quantile_us(0.99);
    const double p99_after = after.quantile_us(0.99);
    std::printf("   %-16s %d stale frames; the others' p99 %.0f us before, %.0f us during, %.0f us after\n",
                who.who.c_str(), stale, p99_before, p99_during, p99_after);
    out.row(
        R"({"bench":"stream","case":"stall with credit 3","who":"%s","viewers":%d,"stale_frames":%d,"before_p99_us":%.1f,"p99_us":%.1f,"after_p99_us":%.1f})",
        who.who.c_str(), viewers, stale, p99_before, p99_during, p99_after);
    verdict.judge(stale <= 3, "%.0f stale frames, at most %.0f", stale, 3);
  }
}

}  // namespace posed::test
