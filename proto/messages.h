// Every message of PROTOCOL.md as a struct. What a field means, and its units, stands there.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/calibration.h"
#include "common/goal.h"
#include "common/pose.h"
#include "common/result.h"
#include "common/scene.h"
#include "common/time.h"

namespace posed::proto {

inline constexpr int kProtocol = 1;
inline constexpr std::size_t kMaxLineBytes = 1 << 20;
inline constexpr int kMaxDepth = 64;
inline constexpr std::size_t kMaxBatch = 1000;  // requests; the answer to a bad one is a hundred times its size
inline constexpr int kDefaultPort = 19870;

// ---- requests ----------------------------------------------------------------------------------------------------

struct Software {
  std::string name, version;
};

// What a peer may do; each may what those before it may.
enum class Role { none, viewer, editor, operator_ };

struct SessionHello {
  int protocol = kProtocol;
  Software client;
  std::string user;
  std::string token = {};
  std::string resume = {};  // of an earlier session, to be the same editor again
};
struct SessionPing {};
struct SessionStatus {};
struct SessionList {};

struct FigureSet {
  std::string id;
  Patched<std::string> template_name;
  Patched<double> stature;
  std::optional<FigureDocument> document;
  Patched<std::string> label;
  Patched<std::string> user;
};
struct FigureGet {
  std::string id;
};
struct FigureList {};
struct FigureRemove {
  std::string id;
};
struct FigurePin {
  std::string figure, segment;
  std::optional<Pin::Hold> hold;  // none: the segment is let go
};

struct GoalSet {
  GoalEdit edit;
};
struct GoalGet {
  std::string id;
};
struct GoalList {};
struct GoalRemove {
  std::string id;
};
struct GoalClear {
  std::string figure;  // empty: of all figures
};

struct ObjectSet {
  ObjectEdit edit;
};
struct ObjectGet {
  std::string id;
};
struct ObjectList {};
struct ObjectRemove {
  std::string id;
};

struct GoalGrab {
  std::string id;
  bool force = false;
};
struct GoalRelease {
  std::string id;
  bool force = false;
};

struct BindingSet {
  BindingEdit edit;
};
struct BindingGet {
  std::string id;
};
struct BindingList {};
struct BindingRemove {
  std::string id;
};

struct CameraSet {
  CameraEdit edit;
};
struct CameraGet {
  std::string id;
};
struct CameraList {};
struct CameraRemove {
  std::string id;
};

// A joint that is kept where it is: before all goals, or as a posture goal of this weight.
struct JointHold {
  std::optional<double> weight;
};
struct JointSet {
  std::string figure, joint;
  std::vector<double> value;  // the joint's share of q; empty: halfplane, deviation, twist
  std::optional<double> halfplane, deviation, twist;
  Patched<JointHold> hold;
};
struct JointGet {
  std::string figure, joint;
};

struct PoseGet {
  std::string figure;
  std::optional<std::uint64_t> min_revision;
  int wait_ms = 0;
};
struct PoseSet {
  std::string figure;
  std::vector<double> q;
};
struct PoseReset {
  std::string figure;
  std::string to = "rest";
};
struct PoseMirror {
  std::string figure;
};

struct SolverGet {};
struct SolverSet {
  Patched<std::string> method;
  Patched<int> iterations;
  Patched<int> branch_iterations;
};

// ---- stateless solves ----

inline constexpr std::size_t kMaxProblems = 10'000;  // of a solve.batch
inline constexpr std::size_t kMaxProblemGoals = 200;
inline constexpr int kMaxDeadlineUs = 10'000'000;

// A figure of the scene by its id, a built-in one, or a document.
struct FigureChoice {
  std::string id;
  std::string template_name;
  double stature = 1.75;
  std::optional<FigureDocument> document;
};
struct Start {
  enum class Kind { rest, current, q } kind = Kind::rest;
  std::vector<double> q;
};
// What a problem says, or a batch says for those of its problems that do not.
struct ProblemSetting {
  std::optional<FigureChoice> figure;
  std::optional<std::map<std::string, Pin>> pins;
  std::optional<Start> start;  // none: from several starts
  std::optional<int> deadline_us;
  std::optional<std::string> method;
};
struct Problem : ProblemSetting {
  std::vector<GoalSet> goals;
};
struct Solve : Problem {
  std::vector<std::string> fields;  // of the answer; empty: all
};
// A problem of a batch, or what is wrong with it: the others are solved all the same.
struct ProblemEntry {
  Problem problem;
  std::optional<Error> error;
  std::string unread;  // JSON text of what is wrong
};
struct SolveBatch : ProblemSetting {
  std::vector<ProblemEntry> problems;
  std::vector<std::string> fields;
  bool progress = false;
};

struct SceneGet {};
struct SceneNew {
  std::string template_name = "standing";
};
struct SceneList {};
struct SceneSave {
  std::string name;
};
struct SceneOpen {
  std::string name;
};
struct SceneRemove {
  std::string name;
};

struct TrackerList {};
struct TrackerGrab {
  std::string tracker;
  bool force = false;
};
struct TrackerRelease {
  std::string tracker;
  bool force = false;
};

// The device's own filter of positions or of attitudes: off, or its four numbers.
struct DeviceFilter {
  bool on = false;
  double sensitivity = 0.0, low = 0.0, high = 0.0, most = 0.0;
};
struct TrackerConfigure {
  std::string tracker;
  bool force = false;
  Patched<std::string> calibration;  // one that is kept; null: none
  Patched<double> rate_hz;
  Patched<std::vector<std::string>> sensors;  // those that are active
  std::map<std::string, Vec3> hemisphere;  // by sensor: towards the half of the field that it is in; zero: it follows
  Patched<DeviceFilter> position_filter, attitude_filter;
};
struct TrackerReset {
  std::string tracker;
  bool force = false;
};

inline constexpr int kMaxTouchMs = 60'000;
inline constexpr std::size_t kMaxAlignPoints = 1000;
// Where a sensor's tip is, measured for a while.
struct TrackerTouch {
  std::string sensor;
  bool force = false;
  int for_ms = 500;
  std::optional<Vec3> point;  // of the world, to compare with
};
struct TrackerAlign {
  std::string tracker, name;  // of the calibration; empty: the chosen one, else "default"
  bool force = false;
  std::vector<AlignedPoint> points;
};
struct TrackerTip {
  std::string sensor, name;
  bool force = false;
  int for_ms = 5000;
  std::optional<Vec3> offset;  // sensor's frame; none: by pivoting
};
struct TrackerBoresight {
  std::string sensor, name;
  bool force = false;
  int for_ms = 500;
  Quat rotation{1.0, 0.0, 0.0, 0.0};  // as which the present orientation is to be read, in the world
};

// A calibration is kept no longer.
struct TrackerForget {
  std::string tracker, name;
  bool force = false;
};

enum class Stream { pose, tracker, scene, stats, camera };
inline constexpr int kStreams = 5;

enum class Encoding { json, cbor };

struct StreamSubscribe {
  Stream stream = Stream::pose;
  std::vector<std::string> figures;  // pose; empty: all
  std::vector<std::string> fields;   // pose; empty: all
  double max_rate_hz = 0.0;          // 0: no cap
  int credit = 0;                    // 0: no credit wanted
  Encoding encoding = Encoding::json;
};
struct StreamUnsubscribe {
  Stream stream = Stream::pose;
};
struct StreamAck {
  Stream stream = Stream::pose;
  std::uint64_t seq = 0;
};

inline constexpr std::size_t kMaxEdits = 1000;       // of an edit.apply
inline constexpr std::size_t kMaxHistory = 1000;     // steps of an edit.history
inline constexpr std::size_t kMaxResumeBytes = 128;  // of a session's key

struct Edit;
struct EditApply {
  std::vector<Edit> edits;
  std::string label;
};
struct EditUndo {
  std::uint64_t step = 0;  // 0: the last one
};
struct EditRedo {};
struct EditHistory {
  int limit = 100;
};

using Params =
    std::variant<SessionHello, SessionPing, SessionStatus, SessionList, FigureSet, FigureGet, FigureList, FigureRemove,
                 FigurePin, GoalSet, GoalGet, GoalList, GoalRemove, GoalClear, GoalGrab, GoalRelease, ObjectSet,
                 ObjectGet, ObjectList, ObjectRemove, BindingSet, BindingGet, BindingList, BindingRemove, CameraSet,
                 CameraGet, CameraList, CameraRemove, JointSet, JointGet, PoseGet, PoseSet, PoseReset, PoseMirror,
                 SolverGet, SolverSet, Solve, SolveBatch, SceneGet, SceneNew, SceneList, SceneSave, SceneOpen,
                 SceneRemove, TrackerList, TrackerGrab, TrackerRelease, TrackerConfigure, TrackerReset, TrackerTouch,
                 TrackerAlign, TrackerTip, TrackerBoresight, TrackerForget, StreamSubscribe, StreamUnsubscribe,
                 StreamAck, EditApply, EditUndo, EditRedo, EditHistory>;

struct Edit {
  std::optional<std::uint64_t> if_revision;  // edits of one entity only
  Params params;
};

struct Request : Edit {
  std::string id;  // JSON text of the id; empty: a notification, which gets no reply
  // Of edits.
  std::string gesture;  // edits of the same one are one step to undo
  std::string once;     // a UUID
  bool force = false;   // whoever holds the goal
};

// What could not be read as a request, and what to answer. Always answered, even without an id ("null").
struct BadRequest {
  std::string id;
  Error error;
};

// One line from a peer.
struct Line {
  bool batch = false;
  std::vector<std::variant<Request, BadRequest>> entries;
};

// ---- results -----------------------------------------------------------------------------------------------------

struct HelloResult {
  Software daemon;
  std::string session, resume, boot;
  Role role = Role::operator_;
  std::vector<std::string> features;
  Nanoseconds t_ns = 0, utc_ns = 0;
};
struct PingResult {
  Nanoseconds receive_t_ns = 0, send_t_ns = 0;
};
struct StatusResult {
  Software daemon;
  Nanoseconds t_ns = 0;
  std::uint64_t revision = 0;
  std::string method;
  int connections = 0;
  std::vector<std::string> figures;
  int goals = 0, bindings = 0, trackers = 0;
  std::uint64_t frames = 0, solves = 0;
  double last_solve_us = 0.0;
};
struct SessionEntry {
  std::string session, address, face, user;
  Software client;
};
struct SessionListResult {
  std::vector<SessionEntry> sessions;
};

struct EditResult {
  std::string id;
  std::uint64_t revision = 0, entity_revision = 0;
};
struct ClearResult {
  int removed = 0;
  std::uint64_t revision = 0;
};
// Of an edit among several: of one entity, or a goal.clear's.
struct AppliedResult : EditResult {
  std::optional<int> removed;
};
struct ApplyResult {
  std::uint64_t revision = 0;
  std::vector<AppliedResult> results;  // in the order of the edits
};
struct StepResult {
  std::uint64_t step = 0, revision = 0;
  std::vector<std::string> entities;  // paths of the document
};
struct HistoryStep {
  std::uint64_t step = 0, revision = 0;
  Nanoseconds t_ns = 0;
  std::string user, session, method, label, gesture;
  std::vector<std::string> entities;
  bool mine = false, undone = false;
};
struct HistoryResult {
  std::vector<HistoryStep> steps;  // newest first
};
struct GrabResult {
  std::string id;
  int idle_ms = 0;
};
struct RevisionResult {
  std::uint64_t revision = 0;
};
struct EmptyResult {};

struct QEntry {
  std::string joint;
  JointType type = JointType::ball;
  int at = 0, size = 0;
};
struct FigureResult {
  FigureEntry entry;        // without q
  FigureDocument document;  // of the template too
  std::uint64_t entity_revision = 0;
  std::vector<QEntry> q_layout;
};
struct FigureSummary {
  std::string id, template_name;
  double stature = 0.0;
  int segments = 0;
  std::uint64_t entity_revision = 0;
};
struct FigureListResult {
  std::vector<FigureSummary> figures;
};
struct GoalResult {
  Goal goal;
  std::uint64_t entity_revision = 0;
  std::string held_by = {};
};
struct GoalListResult {
  std::vector<GoalResult> goals;
};
struct ObjectResult {
  Object object;
  std::uint64_t entity_revision = 0;
};
struct ObjectListResult {
  std::vector<ObjectResult> objects;
};
struct BindingResult {
  Binding binding;
  std::uint64_t entity_revision = 0;
};
struct BindingListResult {
  std::vector<BindingResult> bindings;
};
struct CameraResult {
  Camera camera;
  std::uint64_t entity_revision = 0;
};
struct CameraListResult {
  std::vector<CameraResult> cameras;
};
struct JointResult {
  std::string figure, joint;
  JointType type = JointType::ball;
  std::vector<double> value;
  std::optional<double> halfplane, deviation, twist;  // where the joint rotates
  std::optional<JointHold> hold;
};

// A goal's report with the ids spelled out.
struct GoalFrame {
  std::string id;
  Vec3 touch{0.0, 0.0, 0.0}, target{0.0, 0.0, 0.0};
  double error = 0.0;
  Vec3 force{0.0, 0.0, 0.0};
  GoalState state = GoalState::off;
  struct Because {
    std::string goal;  // empty: one of the others
    double beyond_m = 0.0;
    std::string limit = {};  // a joint's name; its limit on this side
    Cause::Side side = Cause::Side::min;
    std::string pin = {};      // a segment
    std::string binding = {};  // that moves a joint
    std::string figure = {};   // whose limit or pin, where it is another than the goal's
  };
  std::vector<Because> causes;
};
struct FigurePose {
  std::string figure;
  std::vector<Transform> world_from_segment;
  std::vector<double> q;
  std::vector<GoalFrame> goals;
  double cost = 0.0;
  SolveStatus status = SolveStatus::converged;
  bool branch_changed = false;
};
struct PoseResult {
  FigurePose pose;
  Nanoseconds t_ns = 0;
  std::uint64_t revision = 0;
  int iterations = 0, chain_solves = 0;
  std::string method;
  std::vector<std::string> notes;
  double balance_error = 0.0, solve_us = 0.0;
};
struct SolverResult {
  std::string method;
  int iterations = 0, branch_iterations = 0;
};
// Of a stateless solve; q, world_from_segment and goals where they were asked for.
struct SolveResult {
  std::optional<std::vector<double>> q;
  std::optional<std::vector<Transform>> world_from_segment;
  std::optional<std::vector<GoalFrame>> goals;
  double cost = 0.0;
  SolveStatus status = SolveStatus::converged;
  int iterations = 0;
  bool branch_changed = false;
  std::string method;
  std::vector<std::string> notes;
  double solve_us = 0.0;
};
struct Solved {
  SolveResult result;
  std::optional<Error> error;  // then there is no result
};
struct SolveBatchResult {
  std::vector<Solved> results;  // in the order of the problems
};
struct SceneResult {
  std::uint64_t revision = 0;
  SceneDocument document;
};
struct SceneListResult {
  std::vector<std::string> saved, templates;
};
struct TrackerEntry {
  std::string tracker, kind, state, message;
  double rate_hz = 0.0;
  std::uint64_t frames = 0, bad_bytes = 0;
  std::vector<std::string> sensors;
  std::string held_by = {};
  std::string calibration = {};                // the chosen one
  std::vector<Calibration> calibrations = {};  // all that are kept of it
};
struct TrackerGrabResult {
  std::string tracker;
  int idle_ms = 0;
};
struct TouchResult {
  std::string sensor;
  int samples = 0;
  Vec3 position{0.0, 0.0, 0.0};  // of the tip in the world, the mean
  Quat rotation{1.0, 0.0, 0.0, 0.0};
  Vec3 source{0.0, 0.0, 0.0};   // of the tip, as the tracker has it
  double spread_m = 0.0;        // root mean square about the mean
  std::optional<double> off_m;  // from the point that was to be touched
};
struct CalibrationResult {
  Calibration calibration;
};
struct TrackerListResult {
  std::vector<TrackerEntry> trackers;
};
struct SubscribeResult {
  Stream stream = Stream::pose;
};

// ---- what streams carry ------------------------------------------------------------------------------------------

struct PoseFields {
  bool world_from_segment = true, q = true, goals = true;
  bool operator<(const PoseFields& o) const {
    return std::tie(world_from_segment, q, goals) < std::tie(o.world_from_segment, o.q, o.goals);
  }
  bool operator==(const PoseFields&) const = default;
};
struct PoseData {
  Nanoseconds t_ns = 0;
  std::uint64_t revision = 0;
  std::vector<FigurePose> figures;
};
struct SensorData {
  std::string sensor;
  Vec3 position{0.0, 0.0, 0.0};
  Quat rotation{1.0, 0.0, 0.0, 0.0};
  std::uint32_t buttons = 0;
  std::vector<std::string> flags;
  std::uint32_t device_count = 0;
  Nanoseconds device_t_ns = 0;
};
struct CameraFrame {
  std::string camera;
  Transform world_from_camera;
  double fov_y = kDefaultFovY;
  bool operator==(const CameraFrame& o) const {
    return camera == o.camera && world_from_camera.position == o.world_from_camera.position &&
           world_from_camera.rotation == o.world_from_camera.rotation && fov_y == o.fov_y;
  }
};
struct CameraData {
  Nanoseconds t_ns = 0;
  std::vector<CameraFrame> cameras;
};
struct TrackerData {
  Nanoseconds t_ns = 0;
  Nanoseconds sample_t_ns = 0;  // 0: not known
  std::string device;
  std::vector<SensorData> sensors;
};
// Of the last second. Lag: how long after it was measured, as the device's count tells, a sample has come at most;
// jitter: root mean square of how unevenly they came.
struct TrackerStats {
  std::string tracker;
  double rate_hz = 0.0, jitter_us = 0.0, lag_us = 0.0;
};
struct StatsData {
  Nanoseconds t_ns = 0;
  std::uint64_t frames = 0, solves = 0;
  double solve_us = 0.0;           // median of the last second
  double sample_to_send_us = 0.0;  // median of the last second, from the bytes' arrival to the encoded line
  int connections = 0;
  std::uint64_t dropped = 0;
  // Of pose and tracker frames in the last second, from the sample's arrival until the kernel has taken the frame, and
  // until a viewer with credit has acknowledged it. 0: there were none.
  double frame_age_us = 0.0, frame_age_p99_us = 0.0, acked_age_us = 0.0, acked_age_p99_us = 0.0;
  std::vector<TrackerStats> trackers = {};
};

}  // namespace posed::proto
