// A whole daemon in this process: free port, data in a folder of its own, scenes of the source tree.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "client/lib/client.h"
#include "server/daemon/daemon.h"

namespace posed::test {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "posed-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

class RunningDaemon {
 public:
  // `data`: a folder that outlives it; empty: one of its own.
  explicit RunningDaemon(std::vector<std::string> trackers = {}, std::string scene = "standing",
                         const std::filesystem::path& data = {})
      : daemon_(config(std::move(trackers), std::move(scene), data)), thread_([this] { daemon_.run(false); }) {}
  ~RunningDaemon() {
    daemon_.stop();
    thread_.join();
  }

  std::uint16_t port() const { return daemon_.port(); }
  client::Client connect() const {
    auto made = client::Client::connect("tcp://127.0.0.1:" + std::to_string(port()), std::chrono::seconds(60));
    if (!made) throw std::runtime_error(made.error().message);
    return std::move(*made);
  }

 private:
  Config config(std::vector<std::string> trackers, std::string scene, const std::filesystem::path& data) {
    Config c;
    c.port = 0;
    c.trackers = std::move(trackers);
    c.data = data.empty() ? folder_.path() : data;
    c.viewer = folder_.path();
    c.scenes = POSED_SOURCE_DIR "/server/scene/templates";
    c.scene_template = std::move(scene);
    c.log = LogLevel::error;
    // Under a sanitizer on a busy machine a solve may take long; what is solved must not depend on it.
    c.solve_deadline_ms = 10'000;
    return c;
  }

  TemporaryFolder folder_;
  Daemon daemon_;
  std::thread thread_;
};

}  // namespace posed::test
