#include "server/daemon/pipeline.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <thread>
#include <utility>

#include "server/calibration/apply.h"
#include "server/daemon/metrics.h"
#include "server/daemon/requests.h"

namespace posed {
namespace {

constexpr std::size_t kTimesKept = 4096;
constexpr Nanoseconds kStreamPeriod = 1'000'000'000 / 240;

void keep(std::vector<Nanoseconds>& times, Nanoseconds time) {
  if (times.size() < kTimesKept) times.push_back(time);
}

// Microseconds; empties the list.
double median_us(std::vector<Nanoseconds>& times) {
  if (times.empty()) return 0.0;
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  const double us = 1e-3 * static_cast<double>(*middle);
  times.clear();
  return us;
}

}  // namespace

namespace {

// The parts put together: figures with their q.
std::string document_text(const StoredScene& kept) {
  std::map<std::string, std::string> q;
  for (const StoredPart& part : kept.parts) {
    if (part.path.starts_with("/figures/") && part.path.ends_with("/q")) q[part.path] = part.document;
  }
  std::string text = R"({"format":"posed.scene/1")";
  for (const std::string kind : {"figures", "objects", "goals", "bindings", "cameras"}) {
    text += ",\"" + kind + "\":{";
    const std::string prefix = "/" + kind + "/";
    bool first = true;
    for (const StoredPart& part : kept.parts) {
      if (!part.path.starts_with(prefix) || q.contains(part.path)) continue;
      std::string document = part.document;
      if (const auto own = q.find(part.path + "/q"); own != q.end()) {
        document.pop_back();
        document += (document.size() > 1 ? ",\"q\":" : "\"q\":") + own->second + "}";
      }
      text.append(std::exchange(first, false) ? "\"" : ",\"").append(part.path.substr(prefix.size())).append("\":");
      text += document;
    }
    text += "}";
  }
  return text + "}";
}

}  // namespace

Pipeline::Pipeline(Loop& station, net::Server& network, Store& disk, Templates scene_templates,
                   const Clock& daemon_clock)
    : loop(station),
      server(network),
      store(disk),
      templates(std::move(scene_templates)),
      clock(daemon_clock),
      boot(random_key().substr(0, 16)),
      journal(station, disk, scene, calibrations, editing, once,
              [this] {
                publisher.scene_failed();
                wake_solver(false, false);
              }),
      publisher(network, scene, solving, journal),
      problem_solvers(std::max(1u, std::thread::hardware_concurrency())),
      workers(problem_solvers.size()) {
  solve_times_.reserve(kTimesKept);
  sample_to_send_.reserve(kTimesKept);
}

void Pipeline::on_frame(Frame frame) {
  ++frames;
  TrackerState& tracker = trackers[frame.device];
  ++tracker.frames;
  tracker.stations.clear();
  for (const Sample& sample : frame.samples) tracker.stations.push_back(sample.station);
  measuring.hear(frame);
  if (const Calibration* calibration = calibrations.chosen(frame.device)) calibration::apply(*calibration, frame);
  if (!frame.samples.empty() && frame.samples[0].device_t_ns != 0)
    frame.sample_t_ns = tracker.host_clock.measured(frame.samples[0].device_t_ns, frame.t_ns);
  publisher.publish_frame(frame);
  const Scene::Followed moved = scene.follow(frame);
  for (const std::string& binding : moved.saving) save_as_it_stands(binding);
  if (moved.cameras && !moved.pose) publisher.publish_cameras(frame.t_ns);
  if (!moved.pose) return;  // else the cameras come with the pose
  if (!sample_t_ns_) sample_t_ns_ = frame.t_ns;
  pose_t_ns_ = frame.t_ns;
  wake_solver(true);
}

// Under the binding's name and the time, to the millisecond, since nobody is there to type a name.
void Pipeline::save_as_it_stands(const std::string& binding) {
  const Nanoseconds now = utc_now();
  const std::time_t seconds = now / 1'000'000'000;
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char stamp[40];
  const std::size_t size = std::strftime(stamp, sizeof stamp, "-%Y%m%dT%H%M%S", &utc);
  std::snprintf(stamp + size, sizeof stamp - size, ".%03dZ", static_cast<int>(now / 1'000'000 % 1000));
  const std::string name = binding.substr(0, 40) + stamp;
  store.save(name, proto::encode_scene(scene.as_it_stands()), [binding, name](const Status& saved) {
    if (saved)
      log_info("binding " + binding + ": a button has saved the scene as " + name);
    else
      log_warning("binding " + binding + ": a button could not save the scene: " + saved.error().message);
  });
}

void Pipeline::on_line(net::ConnectionId connection, proto::Line line, Nanoseconds receive_t_ns) {
  Requests(*this, connection, receive_t_ns).handle(std::move(line));
}

void Pipeline::edited(net::ConnectionId by, Done done, std::string once_key, bool back, Stored stored) {
  const auto session = sessions.find(by);
  journal.add(std::move(done), std::move(once_key));
  journal.when_stored(std::move(stored));
  publisher.publish_scene(session == sessions.end() ? "posed" : session->second.id);
  pose_t_ns_ = clock.now();
  wake_solver(false, !back);
}

// The solve stands at the end of the queue, so that whatever has arrived by then goes into it: a burst of edits or of
// frames costs one solve, not one each.
void Pipeline::wake_solver(bool live_only, bool explore) {
  solve_live_only_ = solve_live_only_ && live_only;
  solve_explores_ = solve_explores_ || (!live_only && explore);
  if (solve_due_) return;
  solve_due_ = true;
  loop.post([this] { solve(); });
}

void Pipeline::solve() {
  const bool way_to_go = solving.solve(scene, solve_live_only_, clock, solve_explores_);
  solve_due_ = false;
  solve_explores_ = false;
  solve_live_only_ = true;
  if (way_to_go) go_on();
  publisher.publish_pose(pose_t_ns_);
  publisher.publish_cameras(pose_t_ns_);
  journal.write();  // now it carries the pose
  keep(solve_times_, solving.last_solve_ns());
  if (sample_t_ns_) keep(sample_to_send_, clock.now() - *sample_t_ns_);
  sample_t_ns_.reset();
  for (std::size_t i = 0; i < waiters_.size();) {
    if (waiters_[i].revision > solving.revision()) {
      ++i;
      continue;
    }
    Waiter waiter = std::move(waiters_[i]);
    waiters_.erase(waiters_.begin() + static_cast<std::ptrdiff_t>(i));
    reply_pose(waiter.figure, waiter.responder);
  }
}

// A sensor that has jumped and now stands still sends nothing new: the figure catches up at a stream's pace.
void Pipeline::go_on() {
  if (std::exchange(going_on_, true)) return;
  loop.after(kStreamPeriod, [this] {
    going_on_ = false;
    wake_solver(true);
  });
}

Status Pipeline::begin_with(std::string_view text) {
  const Result<SceneDocument> document = proto::decode_scene(text);
  if (!document) return document.error();
  Status loaded = scene.load(*document);
  if (!loaded) return loaded;
  pose_t_ns_ = clock.now();
  journal.add_all();
  wake_solver(false);
  return loaded;
}

Status Pipeline::resume(const StoredScene& kept) {
  const Result<SceneDocument> document = proto::decode_scene(document_text(kept));
  if (!document) return document.error();
  if (Status loaded = scene.load(*document); !loaded) return loaded;
  std::map<std::string, Revision> revisions;
  for (const StoredPart& part : kept.parts) revisions[part.path] = part.revision;
  if (Status loaded = calibrations.load(kept.parts); !loaded) return loaded;
  scene.resume(kept.revision, revisions);
  for (const StoredOnce& edit : kept.once) once.add({edit.uuid, edit.method, edit.result});
  pose_t_ns_ = clock.now();
  wake_solver(false, false);
  return Ok{};
}

void Pipeline::answer_pose(std::string figure, Revision revision, Nanoseconds wait, Responder responder) {
  if (revision <= solving.revision() || wait == 0) return reply_pose(figure, responder);
  const std::uint64_t id = next_waiter_++;
  waiters_.push_back({id, std::move(figure), revision, std::move(responder)});
  loop.after(wait, [this, id] {
    const auto found = std::find_if(waiters_.begin(), waiters_.end(), [&](const Waiter& w) { return w.id == id; });
    if (found == waiters_.end()) return;
    Waiter waiter = std::move(*found);
    waiters_.erase(found);
    reply_pose(waiter.figure, waiter.responder);
  });
}

void Pipeline::reply_pose(const std::string& figure, Responder& responder) const {
  const auto solved = solving.figures().find(figure);
  if (solved == solving.figures().end()) {
    return responder.error({"unknown_figure", "figure " + figure + " is gone", "/params/figure", ""});
  }
  const FigureGroup& group = *solved->second.group;
  const SolveReport& report = group.report();
  proto::PoseResult result;
  result.pose = solving.message(figure);
  result.t_ns = pose_t_ns_;
  result.revision = solving.revision();
  result.iterations = report.iterations;
  result.chain_solves = report.chain_solves;
  result.method = name_of(group.method());
  result.notes = group.notes();
  result.balance_error = report.balance_error;
  result.solve_us = 1e-3 * static_cast<double>(solved->second.solve_ns);
  responder.result(result);
}

void Pipeline::on_tracker(const std::string& id, const std::string& kind, const tracker::Status& status) {
  TrackerState& state = trackers[id];
  if (state.status.state != status.state || state.status.message != status.message) {
    const std::string line = "tracker " + id + ": " + tracker_state_name(status.state) +
                             (status.message.empty() ? "" : ": " + status.message);
    status.state == tracker::State::failed ? log_warning(line) : log_info(line);
  }
  state.kind = kind;
  state.status = status;
  if (status.state != tracker::State::streaming) state.stations = status.stations;
}

void Pipeline::on_opened(net::ConnectionId connection, net::Peer peer) {
  // Not "s" + ...: GCC 12 warns falsely of an overlap in it.
  sessions[connection] = {std::string("s").append(std::to_string(next_session_++)), std::move(peer), "", "", {},
                          tokens ? proto::Role::none : proto::Role::operator_};
}

void Pipeline::on_closed(net::ConnectionId connection) {
  publisher.forget(connection);
  workers.drop(connection);
  editing.gone(connection);
  tracker_holds.release_all(connection);
  sessions.erase(connection);
}

void Pipeline::start() {
  tick();
}

void Pipeline::tick() {
  const net::Counters counters = server.counters();
  proto::StatsData stats;
  stats.t_ns = clock.now();
  stats.frames = frames;
  stats.solves = solving.solves();
  stats.solve_us = median_us(solve_times_);
  stats.sample_to_send_us = median_us(sample_to_send_);
  stats.connections = static_cast<int>(sessions.size());
  stats.dropped = counters.dropped;
  const net::AgeCounts sent = counters.sent_age.since(counted_.sent_age);
  const net::AgeCounts acked = counters.acked_age.since(counted_.acked_age);
  counted_ = counters;
  stats.frame_age_us = sent.quantile_us(0.5);
  stats.frame_age_p99_us = sent.quantile_us(0.99);
  stats.acked_age_us = acked.quantile_us(0.5);
  stats.acked_age_p99_us = acked.quantile_us(0.99);
  for (auto& [id, tracker] : trackers) {
    const tracker::HostClock::Stats arrivals = tracker.host_clock.take();
    const std::uint64_t came = tracker.frames - std::exchange(tracker.counted, tracker.frames);
    if (came > 0) stats.trackers.push_back({id, static_cast<double>(came), arrivals.jitter_us, arrivals.lag_us});
  }
  publisher.publish_stats(stats);
  server.set_page("/metrics", "text/plain; version=0.0.4",
                  std::make_shared<const std::string>(metrics_page(stats, counters, scene.revision())));
  loop.after(1'000'000'000, [this] { tick(); });
}

}  // namespace posed
