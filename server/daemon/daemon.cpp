#include "server/daemon/daemon.h"

#include <set>
#include <stdexcept>
#include <vector>

#include "common/names.h"
#include "server/daemon/loop.h"
#include "server/daemon/pipeline.h"
#include "server/daemon/templates.h"
#include "server/tracker/registry.h"

namespace posed {
namespace {

// Of strangers. On this machine whoever wants to be a nuisance needs no connection for it.
constexpr std::size_t kConnectionsOfOneAddress = 200;
constexpr Nanoseconds kAdmission = 30'000'000'000;  // to say session.hello with a token
constexpr double kLinesOfOnePeer = 2000.0;          // a second
constexpr double kHandshakesOfOneAddress = 20.0;    // a second
constexpr double kPagesOfOneAddress = 100.0;        // a second

net::Options network_options(const Config& config) {
  net::Options options;
  options.host = config.host;
  options.port = config.port;
  options.viewer = config.viewer;
  options.hosts = config.names;
  if (!config.tokens.empty()) {
    options.tokens = std::make_shared<const net::Tokens>(net::Tokens::read(config.tokens));
    options.limits.admission = kAdmission;
  }
  if (!config.tls_key.empty())
    options.tls = std::make_shared<const net::TlsContext>(config.tls_certificate, config.tls_key);
  if (config.beyond_loopback) {
    options.limits.connections_per_address = kConnectionsOfOneAddress;
    options.limits.lines_per_second = kLinesOfOnePeer;
    options.limits.handshakes_per_second = kHandshakesOfOneAddress;
    options.limits.http_requests_per_second = kPagesOfOneAddress;
  }
  return options;
}

std::vector<std::unique_ptr<tracker::Tracker>> make_trackers(const Config& config, const Clock& clock) {
  std::vector<std::unique_ptr<tracker::Tracker>> trackers;
  std::set<std::string> ids;
  tracker::TrackerOptions options;
  options.capture_folder = config.captures;
  for (const std::string& said : config.trackers) {
    // NAME=KIND:ARG; the second of a kind without a name is called KIND-2.
    const std::size_t equals = said.find('=');
    const bool named = equals != std::string::npos && equals < said.find(':');
    const std::string spec = named ? said.substr(equals + 1) : said;
    const std::string kind = spec.substr(0, spec.find(':'));
    options.id = named ? said.substr(0, equals) : "";
    if (named && !valid_id(options.id))
      throw std::runtime_error("--tracker " + said + ": " + options.id +
                               " is no name (letters, digits, '_', '.', '-')");
    for (int n = 2; !named && kind != "replay" && ids.contains(options.id.empty() ? kind : options.id); ++n)
      options.id = kind + "-" + std::to_string(n);
    auto made = tracker::make_tracker(
        spec, [&clock] { return clock.now(); }, options);
    if (!made) {
      const Error& error = made.error();
      throw std::runtime_error("--tracker " + spec + ": " + error.message +
                               (error.hint.empty() ? "" : " (" + error.hint + ")"));
    }
    if (!ids.insert((*made)->id()).second)
      throw std::runtime_error("two trackers are called " + (*made)->id() + ": name one, as in --tracker left=" + spec);
    trackers.push_back(std::move(*made));
  }
  return trackers;
}

}  // namespace

// Members end in the reverse order of their making: the server's and the trackers' threads before what they call.
struct Daemon::Impl {
  explicit Impl(const Config& config)
      : store(config.data),
        network(network_options(config)),
        server(network, handlers(), clock),
        pipeline(loop, server, store, Templates(config.scenes), clock),
        trackers(make_trackers(config, clock)) {
    pipeline.tokens = network.tokens;
    pipeline.configure_device = [this](const std::string& id, const tracker::Settings& settings) -> Status {
      for (auto& tracker : trackers) {
        if (tracker->id() == id) return tracker->configure(settings);
      }
      return Ok{};
    };
    pipeline.solving.deadline_ns = static_cast<Nanoseconds>(config.solve_deadline_ms * 1e6);
    pipeline.solving.method = pipeline.default_method = *find_method(config.solve_method);
    if (store.live().revision > 0 && !config.begin_anew) {
      if (const Status resumed = pipeline.resume(store.live()); !resumed) {
        throw std::runtime_error("the scene in " + (config.data / "posed.db").string() + " cannot be read, at " +
                                 resumed.error().path + ": " + resumed.error().message +
                                 "; it is left as it is: begin anew with --scene.template NAME, or choose another "
                                 "directory with --data");
      }
      return;
    }
    if (const Status loaded = pipeline.calibrations.load(store.live().parts); !loaded)
      throw std::runtime_error("the calibrations in " + (config.data / "posed.db").string() + " cannot be read, at " +
                               loaded.error().path + ": " + loaded.error().message);
    const Result<std::string> text = pipeline.templates.read(config.scene_template);
    if (!text)
      throw std::runtime_error("the scene " + config.scene_template + ": " + text.error().message +
                               (text.error().hint.empty() ? "" : " (" + text.error().hint + ")"));
    if (const Status loaded = pipeline.begin_with(*text); !loaded) {
      throw std::runtime_error("the scene " + config.scene_template + ", at " + loaded.error().path + ": " +
                               loaded.error().message);
    }
  }

  net::Handlers handlers() {
    net::Handlers h;
    h.opened = [this](net::ConnectionId id, net::Peer peer) {
      loop.post([this, id, peer = std::move(peer)] { pipeline.on_opened(id, peer); });
    };
    h.closed = [this](net::ConnectionId id) { loop.post([this, id] { pipeline.on_closed(id); }); };
    h.line = [this](net::ConnectionId id, proto::Line line, Nanoseconds t_ns) {
      loop.post([this, id, t_ns, line = std::move(line)]() mutable { pipeline.on_line(id, std::move(line), t_ns); });
    };
    return h;
  }

  void start_tracker(tracker::Tracker& tracker) {
    pipeline.on_tracker(tracker.id(), tracker.kind(), {});
    tracker::Sink sink;
    sink.frame = [this](Frame frame) {
      loop.post([this, frame = std::move(frame)]() mutable { pipeline.on_frame(std::move(frame)); });
    };
    sink.status = [this, id = tracker.id(), kind = tracker.kind()](tracker::Status status) {
      loop.post([this, id, kind, status = std::move(status)] { pipeline.on_tracker(id, kind, status); });
    };
    tracker.start(std::move(sink));
  }

  Clock clock;
  Loop loop;
  Store store;
  const net::Options network;
  net::Server server;
  Pipeline pipeline;
  std::vector<std::unique_ptr<tracker::Tracker>> trackers;
};

Daemon::Daemon(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
Daemon::~Daemon() = default;

std::uint16_t Daemon::port() const {
  return impl_->server.port();
}

void Daemon::run(bool handle_signals) {
  if (handle_signals) impl_->loop.on_termination([this] { stop(); });
  impl_->pipeline.start();
  impl_->server.start();
  for (auto& tracker : impl_->trackers) impl_->start_tracker(*tracker);
  impl_->loop.run();
  impl_->pipeline.on_stopped();
  for (auto& tracker : impl_->trackers) tracker->stop();
  impl_->server.stop();
}

void Daemon::stop() {
  impl_->loop.stop();
}

}  // namespace posed
