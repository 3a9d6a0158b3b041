// posectl's commands. Each prints what it has to say and returns the exit code.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/cli/view/view.h"
#include "client/lib/client.h"

namespace posed::cli {

inline constexpr int kDone = 0, kRefused = 1, kUsage = 2, kNoDaemon = 3;

struct Session {
  client::Client& client;
  bool json = false;       // results as the daemon sends them
  std::string where = {};  // the daemon's address, as the user wrote it
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
int list_sessions(const Session& session);
int run_watch(const Session& session, const Watch& watch);
// `once`: one picture, as text.
int run_view(const Session& session, const view::Options& options, bool once);

// What is wrong with the trackers of this machine, and with the daemon. Needs none. `root`: for tests, of all that it
// looks at but the daemon.
int run_doctor(const std::string& host, const client::Identity& identity, const std::string& root);

// A line for the file of tokens on standard output; the token itself on standard error. Needs no daemon.
int make_token(const std::string& role, const std::string& name);

// X.set of any entity: as a message, or by its name and its params as a JSON object.
int set_entity(const Session& session, const proto::Params& params);
int set_entity(const Session& session, const std::string& method, const std::string& params);

int list_goals(const Session& session);
int get_goal(const Session& session, const std::string& id);
int remove_goal(const Session& session, const std::string& id);
int clear_goals(const Session& session, const std::string& figure);

int list_figures(const Session& session);
int get_figure(const Session& session, const std::string& id);
int remove_figure(const Session& session, const std::string& id);
// `file`: of the figure's document; empty: none, "-": standard input.
int set_figure(const Session& session, const proto::FigureSet& figure, const std::string& file);
// `hold` as in figure.pin, or "none".
int pin_segment(const Session& session, const std::string& figure, const std::string& segment, const std::string& hold);
int get_joint(const Session& session, const std::string& figure, const std::string& joint, bool degrees);
int set_joint(const Session& session, const proto::JointSet& joint);

int list_objects(const Session& session);
int get_object(const Session& session, const std::string& id);
int remove_object(const Session& session, const std::string& id);
int list_bindings(const Session& session);
int get_binding(const Session& session, const std::string& id);
int remove_binding(const Session& session, const std::string& id);

// `file` of "-" is standard input: the params of edit.apply, or an array of edits.
int apply_edits(const Session& session, const std::string& file, const std::string& label);
int undo_edit(const Session& session, std::uint64_t step);  // 0: the last one
int redo_edit(const Session& session);
int show_history(const Session& session, int limit);

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
int forget_calibration(const Session& session, const proto::TrackerForget& forget);
int bind_sensor(const Session& session, const proto::BindingSet& binding);
int unbind_sensor(const Session& session, std::string id);

Quat looking(const Vec3& from, const Vec3& at);  // a camera's rotation; its Y stays level
int list_cameras(const Session& session);
int set_camera(const Session& session, const proto::CameraSet& camera);
int remove_camera(const Session& session, const std::string& id);

int list_scenes(const Session& session);
int get_scene(const Session& session);
int new_scene(const Session& session, const std::string& template_name);
int save_scene(const Session& session, const std::string& name);
int open_scene(const Session& session, const std::string& name);

// `params` of "-" is read from standard input.
int run_call(const Session& session, const std::string& method, const std::string& params);

}  // namespace posed::cli
