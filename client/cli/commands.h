// posectl's commands. Each prints what it has to say and returns the exit code.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/lib/client.h"

namespace posed::cli {

inline constexpr int kDone = 0, kRefused = 1, kUsage = 2, kNoDaemon = 3;

struct Session {
  client::Client& client;
  bool json = false;  // results as the daemon sends them
};

struct Watch {
  enum class Form { automatic, lines, csv, table };
  proto::Stream stream = proto::Stream::pose;
  double rate_hz = 0.0;     // 0: no cap
  std::uint64_t count = 0;  // 0: for ever
  std::string figure;
  Form form = Form::automatic;  // a table on a terminal, else lines
};

int run_status(const Session& session);
int run_watch(const Session& session, const Watch& watch);

// What is wrong with the trackers of this machine, and with the daemon. Needs none. `root`: for tests, of all that it
// looks at but the daemon.
int run_doctor(const std::string& host, const client::Identity& identity, const std::string& root);

// A line for the file of tokens on standard output; the token itself on standard error. Needs no daemon.
int make_token(const std::string& role, const std::string& name);

int list_goals(const Session& session);
int set_goal(const Session& session, const proto::GoalSet& goal);
int set_goal(const Session& session, const std::string& params);  // a JSON object: goals of every kind
int remove_goal(const Session& session, const std::string& id);
int clear_goals(const Session& session, const std::string& figure);

int get_pose(const Session& session, const std::string& figure);
int reset_pose(const Session& session, const std::string& figure, const std::string& to);
int mirror_pose(const Session& session, const std::string& figure);

// `file` of "-" is standard input: a problem of `solve`, or of `solve.batch`.
int run_solve(const Session& session, const std::string& file, bool batch);

int list_trackers(const Session& session);
int grab_tracker(const Session& session, const proto::TrackerGrab& grab, double seconds);  // 0: until it is ended
int release_tracker(const Session& session, const proto::TrackerRelease& release);
int reset_tracker(const Session& session, const proto::TrackerReset& reset);
int configure_tracker(const Session& session, const proto::TrackerConfigure& configure);
// Asks for one point after the other on standard error, and reads a line of standard input for each.
struct Align {
  std::string sensor, name;
  bool force = false;
  int for_ms = 500;
  std::vector<Vec3> points;  // of the world
};
int align_tracker(const Session& session, const Align& wish);
int calibrate_tip(const Session& session, const proto::TrackerTip& tip);
int check_tracker(const Session& session, proto::TrackerTouch touch);  // no point: the alignment's first
int boresight_tracker(const Session& session, const proto::TrackerBoresight& boresight);
int list_bindings(const Session& session);
int bind_sensor(const Session& session, const proto::BindingSet& binding);
int unbind_sensor(const Session& session, std::string id);

Quat looking(const Vec3& from, const Vec3& at);  // a camera's rotation; its Y stays level
int list_cameras(const Session& session);
int set_camera(const Session& session, const proto::CameraSet& camera);
int remove_camera(const Session& session, const std::string& id);

int list_scenes(const Session& session);
int new_scene(const Session& session, const std::string& template_name);
int save_scene(const Session& session, const std::string& name);
int open_scene(const Session& session, const std::string& name);

// `params` of "-" is read from standard input.
int run_call(const Session& session, const std::string& method, const std::string& params);

}  // namespace posed::cli
