#include "tests/bench/stream/daemon.h"

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

namespace posed::test {

std::unique_ptr<Child> start_daemon(const std::string& tracker, const std::string& data) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "posed";
  const std::uint16_t port = free_port();
  return std::make_unique<Child>(std::vector<std::string>{program, "--tracker", tracker, "--data", data, "--listen",
                                                          "127.0.0.1:" + std::to_string(port)},
                                 port);
}

client::Client connect_to_daemon(const Child& daemon) {
  auto made = client::Client::connect("tcp://127.0.0.1:" + std::to_string(daemon.port()));
  if (!made) throw std::runtime_error(made.error().message);
  return std::move(*made);
}

Nanoseconds clock_offset(client::Client& client) {
  Nanoseconds best = INT64_MAX, offset = 0;
  for (int i = 0; i < 200; ++i) {
    const Nanoseconds before = monotonic_now();
    const auto ping = client.call<proto::PingResult>(proto::SessionPing{});
    const Nanoseconds after = monotonic_now();
    if (!ping || after - before >= best) continue;
    best = after - before;
    offset = (ping->receive_t_ns + ping->send_t_ns) / 2 - (before + after) / 2;
  }
  return offset;
}

}  // namespace posed::test
