// READ FIRST. The whole way of the data, one function a step:
//
//   tracker bytes -> Frame -> on_frame: calibration -> scene.follow -> solve -> publish -> viewers
//   viewer line -> request -> on_line: Requests::handle: editing.edit -> edited -> solve -> publish
//
// All of it runs on the station loop; only the server and the trackers have threads of their own, and they post here.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/frame.h"
#include "common/time.h"
#include "server/daemon/calibrations.h"
#include "server/daemon/journal.h"
#include "server/daemon/loop.h"
#include "server/daemon/measuring.h"
#include "server/daemon/once.h"
#include "server/daemon/publisher.h"
#include "server/daemon/responder.h"
#include "server/daemon/solve_job.h"
#include "server/daemon/solving.h"
#include "server/daemon/templates.h"
#include "server/net/server.h"
#include "server/scene/editing.h"
#include "server/store/store.h"
#include "server/tracker/host_clock.h"
#include "server/tracker/tracker.h"

namespace posed {

struct Session {
  std::string id;  // "s3"
  net::Peer peer;
  std::string user;
  std::string resume;  // after a hello: with the user's name, whose edits these are, on whatever connection
  proto::Software client;
  proto::Role role = proto::Role::none;
  bool token_refused = false;  // and said in the log

  // Who has said no hello is known by the session alone.
  Editor editor() const { return {resume.empty() ? id : user + '\n' + resume, user.empty() ? id : user, id}; }
};

struct TrackerState {
  std::string kind;
  tracker::Status status;
  tracker::HostClock host_clock;  // of devices that tell their time
  std::uint64_t counted = 0;      // frames at the last tick
  // Counted here, since a status comes only now and then.
  std::uint64_t frames = 0;
  std::vector<int> stations;  // of the last frame
};

class Pipeline {
 public:
  Pipeline(Loop& loop, net::Server& server, Store& store, Templates templates, const Clock& clock);

  void on_frame(Frame frame);
  void on_tracker(const std::string& id, const std::string& kind, const tracker::Status& status);
  void on_opened(net::ConnectionId connection, net::Peer peer);
  void on_closed(net::ConnectionId connection);
  // The loop has ended: the last edits, and poses, go to the store.
  void on_stopped() { journal.write(); }
  void on_line(net::ConnectionId connection, proto::Line line, Nanoseconds receive_t_ns);

  // Begins the clockwork of statistics.
  void start();

  // ---- what the handlers of requests use ----

  using Stored = std::function<void(const Status&)>;
  // To be called after every edit: has the figures solved at once, and tells followers and `stored` when the disk has
  // it. `back`: to what was before, so the poses stay near what they are. `once`: the edit's UUID.
  void edited(net::ConnectionId by, Done done, std::string once, bool back, Stored stored);
  // What was added to the journal beside edits goes to the store, with edits that wait for their pose if there are any.
  void store_soon() {
    if (!solve_due_) journal.write();
  }
  // Solves again although nothing was edited.
  void resolve() { wake_solver(false); }
  // The scene to begin with. Nothing changes on an error.
  Status begin_with(std::string_view text);
  // The scene that the store has kept, with its revisions and poses. Errors: "bad_scene" and others of a document.
  Status resume(const StoredScene& kept);
  // Answers with the figure's pose once it is of `revision`, or when the time is up.
  void answer_pose(std::string figure, Revision revision, Nanoseconds wait, Responder responder);

  Loop& loop;
  net::Server& server;
  Store& store;
  const Templates templates;
  const Clock& clock;
  const std::string boot;
  Scene scene;
  Editing editing{scene};
  Calibrations calibrations;
  Measuring measuring{loop};
  Holds tracker_holds{"tracker", "/tracker"};
  // Set by the daemon: hands settings to the tracker of this id. Errors: its, by the names of the fields.
  std::function<Status(const std::string& tracker, const tracker::Settings& settings)> configure_device;
  OnceMemory once;
  Journal journal;
  Solving solving;
  std::shared_ptr<const net::Tokens> tokens;  // none: everybody may do everything
  Method default_method = Method::springs;    // what solver.set goes back to
  Publisher publisher;
  std::map<net::ConnectionId, Session> sessions;
  std::map<std::string, TrackerState> trackers;
  std::uint64_t frames = 0;
  ProblemSolvers problem_solvers;  // one a worker
  WorkerPool workers;

 private:
  struct Waiter {
    std::uint64_t id;
    std::string figure;
    Revision revision;
    Responder responder;
  };

  void save_as_it_stands(const std::string& binding);
  void wake_solver(bool live_only, bool explore = true);
  void solve();
  void go_on();
  void reply_pose(const std::string& figure, Responder& responder) const;
  void tick();

  bool solve_due_ = false;
  bool solve_live_only_ = true;
  bool solve_explores_ = false;
  bool going_on_ = false;
  std::optional<Nanoseconds> sample_t_ns_;  // arrival of the oldest sample that waits for its solve
  Nanoseconds pose_t_ns_ = 0;
  std::vector<Waiter> waiters_;
  std::uint64_t next_waiter_ = 0;
  std::uint64_t next_session_ = 1;
  net::Counters counted_;  // at the last tick
  // Of the last second, bounded.
  std::vector<Nanoseconds> solve_times_, sample_to_send_;
};

}  // namespace posed
