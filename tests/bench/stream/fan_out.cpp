// So many viewers, by everyone in turn.
#include <string>

#include "tests/bench/stream/cases.h"
#include "tests/bench/stream/contestants.h"
#include "tests/bench/stream/measures.h"
#include "tests/bench/stream/viewers.h"

namespace posed::test {
namespace {

struct Round {
  double cpu_us = 0.0, p50_us = 0.0, p99_us = 0.0, p999_us = 0.0, delivered = 0.0, frame_bytes = 0.0;
};

Round run_round(const Contestant& who, int viewers, double rate_hz, Nanoseconds span) {
  const auto child = who.start(rate_hz);
  Viewers load(child->port(), who.framing, who.subscribe, viewers);
  std::uint64_t seq = 0;
  if (who.broker) load.publish(rate_hz, [&seq](Nanoseconds stamp) { return pose_frame(++seq, stamp); });
  load.read_until(monotonic_now() + 400 * kMillisecond);
  const Nanoseconds begin = monotonic_now(), cpu = child->cpu_ns();
  Arrived arrived = load.read_until(begin + span);
  const double used = static_cast<double>(child->cpu_ns() - cpu);
  const double seconds = 1e-9 * static_cast<double>(monotonic_now() - begin);
  const double frames = static_cast<double>(std::max<std::uint64_t>(arrived.frames, 1));
  return {1e-3 * used / frames,
          arrived.quantile_us(0.5),
          arrived.quantile_us(0.99),
          arrived.quantile_us(0.999),
          static_cast<double>(arrived.frames) / (rate_hz * seconds * viewers),
          static_cast<double>(arrived.bytes) / frames};
}

template <class Field>
double median_of(const std::vector<Round>& rounds, Field field) {
  std::vector<double> values;
  for (const Round& round : rounds) values.push_back(round.*field);
  return median(std::move(values));
}

// Of what was measured in the same round.
std::vector<double> ratios(const std::vector<Round>& rounds, const std::vector<Round>& to) {
  std::vector<double> values;
  for (std::size_t i = 0; i < rounds.size(); ++i) values.push_back(rounds[i].cpu_us / to[i].cpu_us);
  return values;
}

}  // namespace

void fan_out(BenchOutput& out, Verdict& verdict, int viewers, double rate_hz) {
  std::string missing;
  std::vector<Contestant> all{bare_loop(), posed_lines(), posed_websocket()};
  if (rate_hz < 240.0) all.push_back(posed_capped(rate_hz));
  for (Contestant& broker : brokers(missing)) all.push_back(std::move(broker));
  std::vector<std::vector<Round>> rounds(all.size());
  const int count = out.quick() ? 1 : kRounds;
  for (int i = 0; i < count; ++i) {
    // Each time another one goes first.
    for (std::size_t k = 0; k < all.size(); ++k) {
      const std::size_t at = (k + static_cast<std::size_t>(i)) % all.size();
      rounds[at].push_back(
          run_round(all[at], viewers, rate_hz, out.quick() ? 300 * kMillisecond : 1200 * kMillisecond));
    }
  }
  std::printf("\n%d viewers x %.0f Hz, medians of %d round%s\n", viewers, rate_hz, count, count == 1 ? "" : "s");
  if (!missing.empty()) std::printf("   not here (Debian packages):%s\n", missing.c_str());
  std::printf("   %-16s %12s %8s %9s %9s %9s %10s %8s\n", "who", "cpu_us/frame", "x floor", "p50_us", "p99_us",
              "p99.9_us", "delivered", "frame_B");
  const auto named = [&](const char* who) -> const std::vector<Round>* {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].who == who) return &rounds[i];
    }
    return nullptr;
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& r = rounds[i];
    const double cpu = median_of(r, &Round::cpu_us), ratio = median(ratios(r, rounds[0]));
    const double p50 = median_of(r, &Round::p50_us), p99 = median_of(r, &Round::p99_us);
    const double p999 = median_of(r, &Round::p999_us), delivered = median_of(r, &Round::delivered);
    const double bytes = median_of(r, &Round::frame_bytes);
    std::printf("   %-16s %12.2f %8.2f %9.0f %9.0f %9.0f %9.2f%% %8.0f\n", all[i].who.c_str(), cpu, ratio, p50, p99,
                p999, 100.0 * delivered, bytes);
    out.row(
        R"({"bench":"stream","case":"%d x %.0f Hz","who":"%s","viewers":%d,"rate_hz":%.0f,"cpu_us_per_frame":%.3f,"ratio_floor":%.3f,"median_us":%.1f,"p99_us":%.1f,"p999_us":%.1f,"ok":%.4f,"frame_bytes":%.0f,"rounds":%d})",
        viewers, rate_hz, all[i].who.c_str(), viewers, rate_hz, cpu, ratio, p50, p99, p999, delivered, bytes, count);
  }
  const auto* const tcp = named("posed/tcp");
  const auto* const websocket = named("posed/websocket");
  if (viewers == 100) {
    const double tcp_ratio = median(ratios(*tcp, rounds[0])), ws_ratio = median(ratios(*websocket, rounds[0]));
    verdict.judge(tcp_ratio <= 1.4, "TCP costs %.2f times the floor, at most %.1f", tcp_ratio, 1.4);
    verdict.judge(ws_ratio <= 2.0, "WebSocket costs %.2f times the floor, at most %.1f", ws_ratio, 2.0);
    const double floor_p99 = median_of(rounds[0], &Round::p99_us);
    for (const auto* const ours : {tcp, websocket}) {
      const double later = median_of(*ours, &Round::p99_us) / floor_p99;
      verdict.judge(later <= 2.0,
                    ours == tcp ? "TCP's p99 is %.2f times the floor's, at most %.1f"
                                : "WebSocket's p99 is %.2f times the floor's, at most %.1f",
                    later, 2.0);
    }
    if (const auto* const nats = named("nats-server")) {
      const double share = median(ratios(*tcp, *nats));
      verdict.judge(share < 0.5, "TCP costs %.2f of what nats-server does, less than %.1f", share, 0.5);
    }
    return;
  }
  const double bar = rate_hz < 100.0 ? 0.999 : 0.97, able = median_of(rounds[0], &Round::delivered);
  if (able < 0.99) {
    std::printf("   not judged: on this machine, now, the floor itself delivers %.1f%%\n", 100.0 * able);
    return;
  }
  for (const auto* posed : {tcp, websocket}) {
    const double delivered = median_of(*posed, &Round::delivered);
    verdict.judge(delivered >= bar,
                  posed == tcp ? "TCP delivers %.4f, at least %.3f" : "WebSocket delivers %.4f, at least %.3f",
                  delivered, bar);
  }
}

}  // namespace posed::test
