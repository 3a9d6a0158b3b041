// Edits: how long one waits for the reply, which comes when the disk has it, alone and with many viewers looking on.
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <thread>

#include "tests/bench/stream/cases.h"
#include "tests/bench/stream/contestants.h"
#include "tests/bench/stream/daemon.h"
#include "tests/bench/stream/folder.h"
#include "tests/bench/stream/measures.h"
#include "tests/bench/stream/viewers.h"

namespace posed::test {
namespace {

constexpr const char* kPlaces[] = {"right_hand", "left_hand", "head", "upper_torso", "right_foot", "left_foot"};

// A drag: the goal goes round a small circle.
std::string goal_set(int editor, int number) {
  const double turn = 0.2 * number;
  char text[400];
  std::snprintf(text, sizeof text,
                R"({"jsonrpc":"2.0","id":%d,"method":"goal.set","params":{"id":"e%d","at":"%s",)"
                R"("position":[%.4f,%.4f,%.4f],"weight":3,"gesture":"drag-%d-%d"}})"
                "\n",
                number, editor, kPlaces[static_cast<std::size_t>(editor) % std::size(kPlaces)],
                0.3 + 0.1 * std::cos(turn), 0.2 * (editor % 3 - 1), 1.1 + 0.1 * std::sin(turn), editor, number / 100);
  return text;
}

// Each edits so many times a second, one after the other in even steps, whether its replies come or not.
class Editors {
 public:
  Editors(std::uint16_t port, int count, double rate_hz) : rate_hz_(rate_hz) {
    for (int i = 0; i < count; ++i) peers_.push_back({connect_to(port), "", {}});
  }
  ~Editors() {
    for (const Peer& peer : peers_) close(peer.fd);
  }

  void run_until(Nanoseconds end) {
    const Nanoseconds step = static_cast<Nanoseconds>(1e9 / (rate_hz_ * static_cast<double>(peers_.size())));
    Nanoseconds due = monotonic_now();
    for (std::uint64_t turn = 0; monotonic_now() < end; due += step, ++turn) {
      for (Nanoseconds left; (left = due - monotonic_now()) > 0;) listen(left);
      Peer& peer = peers_[turn % peers_.size()];
      peer.sent.push_back(monotonic_now());
      send_all(peer.fd, goal_set(static_cast<int>(turn % peers_.size()), static_cast<int>(peer.sent.size())));
    }
    const Nanoseconds patience = monotonic_now() + 5 * kSecond;
    while (answered_ < asked() && monotonic_now() < patience) listen(10 * kMillisecond);
  }
  std::size_t asked() const {
    std::size_t all = 0;
    for (const Peer& peer : peers_) all += peer.sent.size();
    return all;
  }
  std::size_t answered() const { return answered_; }
  std::size_t refused() const { return refused_; }
  Arrived replies;  // their ages are from the request to its reply

 private:
  struct Peer {
    int fd;
    std::string rest;
    std::vector<Nanoseconds> sent;  // by the request's id, from 1
  };

  void listen(Nanoseconds patience) {
    std::vector<pollfd> ready;
    for (const Peer& peer : peers_) ready.push_back({peer.fd, POLLIN, 0});
    const timespec wait{patience / kSecond, patience % kSecond};
    if (ppoll(ready.data(), ready.size(), &wait, nullptr) <= 0) return;
    for (std::size_t i = 0; i < ready.size(); ++i) {
      if (ready[i].revents != 0) read(peers_[i]);
    }
  }
  void read(Peer& peer) {
    char bytes[16384];
    const ssize_t got = recv(peer.fd, bytes, sizeof bytes, 0);
    if (got <= 0) throw std::runtime_error("the daemon has closed an editor's connection");
    peer.rest.append(bytes, static_cast<std::size_t>(got));
    const Nanoseconds now = monotonic_now();
    for (std::size_t end; (end = peer.rest.find('\n')) != std::string::npos; peer.rest.erase(0, end + 1)) {
      const std::string_view line = std::string_view(peer.rest).substr(0, end);
      const std::size_t at = line.find("\"id\":") + 5;
      std::size_t id = 0;
      std::from_chars(line.data() + at, line.data() + line.size(), id);
      ++answered_;
      refused_ += line.find("\"error\"") != std::string_view::npos;
      if (id >= 1 && id <= peer.sent.size())
        replies.ages_us.push_back(1e-3f * static_cast<float>(now - peer.sent[id - 1]));
    }
  }

  const double rate_hz_;
  std::vector<Peer> peers_;
  std::size_t answered_ = 0, refused_ = 0;
};

// What the disk itself takes to have a page for sure.
Arrived syncs(const std::string& folder, int count) {
  const std::string page(4096, 'x'), name = folder + "/sync";
  const int fd = open(name.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  Arrived all;
  for (int i = 0; i < count; ++i) {
    const Nanoseconds before = monotonic_now();
    if (write(fd, page.data(), page.size()) != static_cast<ssize_t>(page.size()) || fdatasync(fd) != 0)
      throw std::runtime_error("cannot write " + name);
    all.ages_us.push_back(1e-3f * static_cast<float>(monotonic_now() - before));
  }
  close(fd);
  return all;
}

}  // namespace

void editors_and_viewers(BenchOutput& out, Verdict& verdict) {
  const int viewers = 1000, editors = 20;
  const double rate_hz = 60.0, edits_hz = 30.0;
  const Folder memory(Folder::kInMemory), disk;
  Arrived sync = syncs(disk.path(), out.quick() ? 20 : 300);
  std::printf("\n%d viewers at %.0f Hz and %d editors at %.0f edits a second; data in memory\n", viewers, rate_hz,
              editors, edits_hz);
  const auto daemon = start_daemon("simulated:" + std::to_string(out.seed()), memory.path());
  Viewers load(daemon->port(), Framing::lines, subscribe_line(0, rate_hz), viewers);
  const Nanoseconds span = out.quick() ? kSecond : 10 * kSecond;
  Editors edit(daemon->port(), editors, edits_hz);
  load.read_until(monotonic_now() + 200 * kMillisecond);
  std::exception_ptr broken;
  const Nanoseconds begin = monotonic_now(), cpu = daemon->cpu_ns();
  std::thread other([&] {
    try {
      edit.run_until(begin + span);
    } catch (...) {
      broken = std::current_exception();
    }
  });
  Arrived arrived = load.read_until(begin + span);
  const double used =
      100.0 * static_cast<double>(daemon->cpu_ns() - cpu) / static_cast<double>(monotonic_now() - begin);
  load.read_until(monotonic_now() + kSecond / 2);
  other.join();
  if (broken) std::rethrow_exception(broken);
  const double delivered = static_cast<double>(arrived.frames) / (rate_hz * 1e-9 * static_cast<double>(span) * viewers);
  const double p50 = edit.replies.quantile_us(0.5), p99 = edit.replies.quantile_us(0.99);
  std::printf(
      "   %-16s %zu edits of %zu answered, %zu refused: p50 %.0f us, p99 %.0f us; %.1f %% of the frames, "
      "%.0f %% of a core\n",
      "posed/springs", edit.answered(), edit.asked(), edit.refused(), p50, p99, 100.0 * delivered, used);
  std::printf("   %-16s fdatasync of a page: p50 %.0f us, p99 %.0f us\n", "the disk itself", sync.quantile_us(0.5),
              sync.quantile_us(0.99));
  out.row(
      R"({"bench":"stream","case":"%d viewers, %d editors","who":"posed/springs","viewers":%d,"editors":%d,"edits_per_s":%.0f,"median_us":%.1f,"p99_us":%.1f,"ok":%.4f,"refused":%zu,"core_percent":%.1f,"fsync_p99_us":%.1f})",
      viewers, editors, viewers, editors, editors * edits_hz, p50, p99, delivered, edit.refused(), used,
      sync.quantile_us(0.99));
  verdict.judge(edit.answered() == edit.asked() && edit.refused() == 0, "%.0f edits were not answered, at most %.0f",
                static_cast<double>(edit.asked() - edit.answered() + edit.refused()), 0);
  verdict.judge(p99 < 50'000, "replies come within %.0f us at p99, less than %.0f", p99, 50'000);
}

void durable_edits(BenchOutput& out) {
  std::printf("\ngoal.set, answered when the disk has it\n");
  for (const auto& [where, place] : {std::pair{"disk", Folder::kOnDisk}, std::pair{"memory", Folder::kInMemory}}) {
    const Folder folder(place);
    const auto daemon = start_daemon("simulated:" + std::to_string(out.seed()), folder.path());
    for (const int depth : {1, 32}) {
      const int fd = connect_to(daemon->port());
      Arrived replies;
      std::string rest;
      std::vector<Nanoseconds> sent;
      std::size_t answered = 0;
      const Nanoseconds begin = monotonic_now(), span = out.quick() ? kSecond / 4 : 3 * kSecond;
      while (monotonic_now() - begin < span) {
        std::string lines;
        while (sent.size() - answered < static_cast<std::size_t>(depth)) {
          sent.push_back(monotonic_now());
          lines += goal_set(0, static_cast<int>(sent.size()));
        }
        send_all(fd, lines);
        char bytes[65536];
        const ssize_t got = recv(fd, bytes, sizeof bytes, 0);
        if (got <= 0) throw std::runtime_error("the daemon has closed the connection");
        rest.append(bytes, static_cast<std::size_t>(got));
        const Nanoseconds now = monotonic_now();
        // In the order of the requests.
        for (std::size_t end; (end = rest.find('\n')) != std::string::npos; rest.erase(0, end + 1)) {
          if (rest.find("\"error\"") < end) throw std::runtime_error(rest.substr(0, end));
          replies.ages_us.push_back(1e-3f * static_cast<float>(now - sent[answered++]));
        }
      }
      const double rate = static_cast<double>(answered) / (1e-9 * static_cast<double>(monotonic_now() - begin));
      close(fd);
      std::printf("   data in/on %-6s %2d under way  %8.0f a second, p50 %.0f us, p99 %.0f us\n", where, depth, rate,
                  replies.quantile_us(0.5), replies.quantile_us(0.99));
      out.row(
          R"({"bench":"stream","case":"durable goal.set depth %d","who":"posed/springs","data":"%s","calls_per_s":%.0f,"median_us":%.1f,"p99_us":%.1f})",
          depth, where, rate, replies.quantile_us(0.5), replies.quantile_us(0.99));
    }
  }
}

}  // namespace posed::test
