// What a peer asks: the parameters of every method of PROTOCOL.md, and a line of requests. What a field means, and its
// units, stands there.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/calibration.h"
#include "common/goal.h"
#include "common/result.h"
#include "common/scene.h"

namespace posed::proto {

inline constexpr int kProtocol = 1;
inline constexpr std::size_t kMaxLineBytes = 1 << 20;
inline constexpr int kMaxDepth = 64;
inline constexpr std::size_t kMaxBatch = 1000;  // requests; the answer to a bad one is a hundred times its size
inline constexpr int kDefaultPort = 19870;

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

}  // namespace posed::proto
