// What a method answers with, of PROTOCOL.md. What a field means, and its units, stands there.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/calibration.h"
#include "common/pose.h"
#include "common/result.h"
#include "common/scene.h"
#include "common/time.h"
#include "proto/requests.h"

namespace posed::proto {

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

}  // namespace posed::proto
