#include <csignal>
#include <cstdio>
#include <exception>

#include "server/daemon/config.h"
#include "server/daemon/daemon.h"

int main(int argc, char** argv) {
  int exit_code = 0;
  const auto config = posed::read_config(argc, argv, exit_code);
  if (!config) return exit_code;
  posed::set_log_level(config->log);
  std::signal(SIGPIPE, SIG_IGN);
  try {
    posed::Daemon daemon(*config);
    const bool v6 = config->host.find(':') != std::string::npos;
    std::printf("posed: the viewer is at http%s://%s%s%s:%u/ (stop with Ctrl-C)\n", config->tls_key.empty() ? "" : "s",
                v6 ? "[" : "", config->host.c_str(), v6 ? "]" : "", static_cast<unsigned>(daemon.port()));
    std::fflush(stdout);
    daemon.run(true);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "posed: %s\n", error.what());
    return 1;
  }
  posed::log_info("stopped");
  return 0;
}
