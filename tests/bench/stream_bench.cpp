// bench_stream [--out FILE] [--seed N] [--quick]: the real daemon with a sensor bound to a hand's goal at 240 Hz, and
// 1, 10 and 100 viewers of the pose stream on loopback. Sample-to-socket latency is from the sample's arrival in the
// daemon (the frame's t_ns) to the last byte of its pose at the viewer; solve, encoding and the viewers before this one
// are in it.
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <exception>
#include <vector>

#include "proto/framing.h"
#include "tests/bench/bench_output.h"
#include "tests/integration/running_daemon.h"

namespace {

using namespace posed;

constexpr double kRate = 240.0;

// The daemon's clock as we read it: the pings with the shortest way there and back decide.
Nanoseconds clock_offset(client::Client& client, const Clock& ours) {
  Nanoseconds best = INT64_MAX, offset = 0;
  for (int i = 0; i < 200; ++i) {
    const Nanoseconds before = ours.now();
    const auto ping = client.call<proto::PingResult>(proto::SessionPing{});
    const Nanoseconds after = ours.now();
    if (!ping || after - before >= best) continue;
    best = after - before;
    offset = (ping->receive_t_ns + ping->send_t_ns) / 2 - (before + after) / 2;
  }
  return offset;
}

class Viewer {
 public:
  explicit Viewer(std::uint16_t port) : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("cannot connect");
    const std::string line = proto::encode_request(1, proto::StreamSubscribe{}) + "\n";
    if (write(fd_, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
      throw std::runtime_error("cannot write");
    fcntl(fd_, F_SETFL, O_NONBLOCK);
  }
  ~Viewer() { close(fd_); }
  Viewer(Viewer&& o) noexcept : fd_(std::exchange(o.fd_, -1)), splitter_(std::move(o.splitter_)) {}
  int fd() const { return fd_; }

  // Calls `seen` with t_ns of each pose that has arrived whole, and counts its bytes.
  template <class Seen>
  void read_all(Seen seen) {
    char buffer[64 << 10];
    for (;;) {
      const ssize_t size = read(fd_, buffer, sizeof buffer);
      if (size <= 0) return;
      if (!splitter_.push({buffer, static_cast<std::size_t>(size)})) throw std::runtime_error("a line without end");
      while (const auto line = splitter_.next()) {
        const std::size_t at = line->find("\"t_ns\":");
        if (at == std::string_view::npos || line->find("stream.frame") == std::string_view::npos) continue;
        Nanoseconds t_ns = 0;
        std::from_chars(line->data() + at + 7, line->data() + line->size(), t_ns);
        seen(t_ns, line->size());
      }
    }
  }

 private:
  int fd_;
  proto::LineSplitter splitter_{1 << 20};
};

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void measure(test::BenchOutput& out, int count, double seconds) {
  const test::RunningDaemon daemon({"simulated:" + std::to_string(out.seed())});
  auto control = daemon.connect();
  for (const auto& [method, params] :
       {std::pair{"goal.set", R"({"id":"hand","at":"right_hand","position":[0.4,-0.3,1.2]})"},
        std::pair{"binding.set", R"({"sensor":"simulated:1","to":{"goal":"hand"}})"}}) {
    if (const auto done = control.call(method, params); !done) throw std::runtime_error(done.error().message);
  }
  const Clock ours;
  const Nanoseconds offset = clock_offset(control, ours);
  std::vector<Viewer> viewers;
  for (int i = 0; i < count; ++i) viewers.emplace_back(daemon.port());
  std::vector<pollfd> polls;
  for (const Viewer& v : viewers) polls.push_back({v.fd(), POLLIN, 0});

  std::vector<double> latency_us;
  latency_us.reserve(static_cast<std::size_t>(count * kRate * seconds * 1.1));
  std::size_t bytes = 0;
  const Nanoseconds begin = ours.now() + 500'000'000;  // the first half second warms up
  const Nanoseconds end = begin + static_cast<Nanoseconds>(seconds * 1e9);
  double cpu = 0.0;
  for (bool warm = false; ours.now() < end;) {
    if (!warm && ours.now() >= begin) warm = true, cpu = cpu_seconds();
    poll(polls.data(), polls.size(), 20);
    for (std::size_t i = 0; i < viewers.size(); ++i) {
      if (!(polls[i].revents & POLLIN)) continue;
      viewers[i].read_all([&](Nanoseconds t_ns, std::size_t size) {
        if (!warm) return;
        latency_us.push_back(1e-3 * static_cast<double>(ours.now() + offset - t_ns));
        bytes = size;
      });
    }
  }
  cpu = cpu_seconds() - cpu;
  if (latency_us.empty()) throw std::runtime_error("no frame arrived");
  std::sort(latency_us.begin(), latency_us.end());
  const auto quantile = [&](double p) {
    return latency_us[static_cast<std::size_t>(p * static_cast<double>(latency_us.size() - 1))];
  };
  const double due = kRate * seconds * count, delivered = static_cast<double>(latency_us.size());
  std::printf("%8d %8.0f %10.0f %8.2f%% %9.0f %9.0f %9.0f %10zu %14.2f\n", count, kRate, delivered / seconds,
              100.0 * delivered / due, quantile(0.5), quantile(0.99), quantile(0.999), bytes, 1e6 * cpu / delivered);
  out.row(
      R"({"bench":"stream","case":"tcp %d x 240 Hz","who":"posed/springs","viewers":%d,"rate_hz":240,"delivered_per_s":%.0f,"ok":%.4f,"median_us":%.1f,"p99_us":%.1f,"p999_us":%.1f,"frame_bytes":%zu,"cpu_us_per_frame_both_ends":%.2f})",
      count, count, delivered / seconds, delivered / due, quantile(0.5), quantile(0.99), quantile(0.999), bytes,
      1e6 * cpu / delivered);
}

}  // namespace

int main(int argc, char** argv) try {
  posed::test::BenchOutput out(argc, argv);
  std::printf("%8s %8s %10s %9s %9s %9s %9s %10s %14s\n", "viewers", "rate_hz", "delivered/s", "of due", "p50_us",
              "p99_us", "p99.9_us", "frame_B", "cpu_us/frame");
  for (const int viewers : {1, 10, 100}) measure(out, viewers, out.quick() ? 1.0 : 10.0);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_stream: %s\n", e.what());
  return 1;
}
