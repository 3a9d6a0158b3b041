#include "server/daemon/config.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>

namespace posed {
namespace {

std::filesystem::path share() {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? "/usr/share/posed" : self.parent_path().parent_path() / "share" / "posed";
}

// Under systemd the unit's StateDirectory, else the user's XDG state folder.
std::filesystem::path default_data() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value ? value : "");
  };
  if (const std::string service = variable("STATE_DIRECTORY"); !service.empty()) return service;
  if (const std::string state = variable("XDG_STATE_HOME"); !state.empty())
    return std::filesystem::path(state) / "posed";
  if (const std::string home = variable("HOME"); !home.empty())
    return std::filesystem::path(home) / ".local/state/posed";
  return "/var/lib/posed";
}

// HOST:PORT, with an IPv6 host in brackets. Throws CLI::ValidationError.
void parse_listen(const std::string& text, Config& config) {
  const std::size_t colon = text.rfind(':');
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(colon == std::string::npos ? end : text.data() + colon + 1, end, config.port);
  if (parsed.ec != std::errc{} || parsed.ptr != end || colon == 0) {
    throw CLI::ValidationError("--listen", "\"" + text + "\" is not HOST:PORT, as in 127.0.0.1:19870");
  }
  config.host = text.substr(0, colon);
  if (config.host.starts_with('[') && config.host.ends_with(']'))
    config.host = config.host.substr(1, config.host.size() - 2);
}

bool loopback(const std::string& host) {
  return host.starts_with("127.") || host == "::1" || host == "localhost";
}

}  // namespace

std::optional<Config> read_config(int argc, const char* const* argv, int& exit_code) {
  Config config;
  config.data = default_data();
  config.viewer = share() / "viewer";
  config.scenes = share() / "scenes";
  std::string listen = "127.0.0.1:19870", level = "info";
  bool open_network = false;

  CLI::App app("posed: owns 6-DOF trackers and a solver for articulated figures, and serves them to viewers.", "posed");
  app.set_version_flag("--version", "posed " POSED_VERSION);
  app.set_config("--config", "", "a file of KEY = VALUE lines, with the names of these options");
  // Dots are part of our names, not sections of the file.
  app.get_config_formatter_base()->parentSeparator('\x1f');
  app.add_option("--listen", listen, "HOST:PORT of JSON lines, WebSocket and the viewer")->capture_default_str();
  app.add_option("--tracker", config.trackers,
                 "KIND[:ARG]: simulated[:SEED], liberty, patriot, fastrak, isotrak, viper, spacemouse, each "
                 "[:usb[:SERIAL or PORT]] or "
                 "[:/dev/ttyS0[@BAUD]] as it has it; replay:FILE[@fast]; may be given again")
      ->allow_extra_args(false);
  app.add_option("--capture", config.captures,
                 "a folder: trackers write there what they hear, for --tracker replay:FILE");
  app.add_option("--data", config.data, "the folder of what must survive")->capture_default_str();
  app.add_option("--log", level, "debug, info, warning or error")
      ->check(CLI::IsMember({"debug", "info", "warning", "error"}));
  app.add_option("--scene.template", config.scene_template,
                 "the scene that a fresh data directory begins with; said on the command line, any")
      ->capture_default_str();
  app.add_option("--scene.path", config.scenes, "the folder of scene templates")->capture_default_str();
  app.add_option("--viewer.path", config.viewer, "the folder of the built viewer")->capture_default_str();
  app.add_option("--solver.method", config.solve_method, "springs, or reach_tree: the paper's own")
      ->check(CLI::IsMember({"springs", "reach_tree"}).description(""))
      ->capture_default_str();
  app.add_option("--solver.deadline_ms", config.solve_deadline_ms, "a solve ends after this time")
      ->check(CLI::Range(0.1, 10'000.0))
      ->capture_default_str();
  app.add_option("--auth.tokens", config.tokens, "the file of who may come in; posectl token makes its lines");
  app.add_option("--tls.certificate", config.tls_certificate, "a certificate in PEM, with those that lead to its root");
  app.add_option("--tls.key", config.tls_key, "its private key in PEM");
  app.add_flag("--listen.open", open_network, "accept an address beyond loopback without tokens or TLS");
  app.add_option("--listen.name", config.names, "a name by which browsers may call the daemon; may be given again")
      ->allow_extra_args(false);
  try {
    app.parse(argc, argv);
    parse_listen(listen, config);
    // The file says what to begin with; to replace a scene that is there takes a word of its own.
    config.begin_anew = std::any_of(
        argv + 1, argv + argc, [](const char* word) { return std::string_view(word).starts_with("--scene.template"); });
    if (config.tls_certificate.empty() != config.tls_key.empty())
      throw CLI::ValidationError("--tls.certificate", "a certificate and its --tls.key go together");
    config.beyond_loopback = !loopback(config.host);
    if (config.beyond_loopback && !open_network && (config.tokens.empty() || config.tls_key.empty())) {
      throw CLI::ValidationError("--listen", config.host +
                                                 " can be reached from the network, and anybody there could edit; give "
                                                 "--auth.tokens, --tls.certificate and "
                                                 "--tls.key, or say --listen.open to accept that");
    }
  } catch (const CLI::Success& success) {
    exit_code = app.exit(success);
    return std::nullopt;
  } catch (const CLI::Error& error) {
    std::fprintf(stderr, "posed: %s (posed --help lists the options)\n", error.what());
    exit_code = 2;
    return std::nullopt;
  }
  config.log = level == "debug"     ? LogLevel::debug
               : level == "warning" ? LogLevel::warning
               : level == "error"   ? LogLevel::error
                                    : LogLevel::info;
  return config;
}

}  // namespace posed
