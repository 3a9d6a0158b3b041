// Private to the codec: the fields of every result and of what streams carry.
#pragma once

#include "proto/describe.h"

namespace posed::proto {

struct Clocks {
  Nanoseconds& t_ns;
  Nanoseconds& utc_ns;
};
template <class V>
void describe(V& v, Clocks& m) {
  v.required("t_ns", m.t_ns);
  v.required("utc_ns", m.utc_ns);
}

template <class V>
void describe(V& v, HelloResult& m) {
  int protocol = kProtocol;
  v.required("protocol", protocol);
  v.required("daemon", m.daemon);
  v.required("session", m.session);
  v.optional("resume", m.resume);
  v.required("boot", m.boot);
  v.required("role", m.role);
  v.required("features", m.features);
  if constexpr (!V::kReads) v.constant("axes", Json{{"up", "z"}, {"forward", "x"}, {"handed", "right"}});
  Clocks clocks{m.t_ns, m.utc_ns};
  v.required("clock", clocks);
  if constexpr (!V::kReads)
    v.constant("limits", Json{{"line_bytes", kMaxLineBytes}, {"depth", kMaxDepth}, {"batch", kMaxBatch}});
}

template <class V>
void describe(V& v, PingResult& m) {
  v.required("receive_t_ns", m.receive_t_ns);
  v.required("send_t_ns", m.send_t_ns);
}

template <class V>
void describe(V& v, StatusResult& m) {
  v.required("daemon", m.daemon);
  v.required("t_ns", m.t_ns);
  v.required("revision", m.revision);
  v.required("method", m.method);
  v.required("connections", m.connections);
  v.required("figures", m.figures);
  v.required("goals", m.goals);
  v.required("bindings", m.bindings);
  v.required("trackers", m.trackers);
  v.required("frames", m.frames);
  v.required("solves", m.solves);
  v.required("last_solve_us", m.last_solve_us);
}

template <class V>
void describe(V& v, SessionEntry& m) {
  v.required("session", m.session);
  v.required("address", m.address);
  v.required("face", m.face);
  v.required("user", m.user);
  v.required("client", m.client);
}
template <class V>
void describe(V& v, SessionListResult& m) {
  v.required("sessions", m.sessions);
}

template <class V>
void describe(V& v, EditResult& m) {
  v.required("id", m.id);
  v.required("revision", m.revision);
  v.required("entity_revision", m.entity_revision);
}
template <class V>
void describe(V& v, AppliedResult& m) {
  if (V::kReads || m.removed) v.optional("removed", m.removed);
  if (m.removed)
    v.required("revision", m.revision);
  else
    describe(v, static_cast<EditResult&>(m));
}
template <class V>
void describe(V& v, ApplyResult& m) {
  v.required("revision", m.revision);
  v.required("results", m.results);
}
template <class V>
void describe(V& v, StepResult& m) {
  v.required("step", m.step);
  v.required("revision", m.revision);
  v.required("entities", m.entities);
}
template <class V>
void describe(V& v, HistoryStep& m) {
  v.required("step", m.step);
  v.required("revision", m.revision);
  v.required("t_ns", m.t_ns);
  v.required("user", m.user);
  v.required("session", m.session);
  v.required("method", m.method);
  v.optional("label", m.label);
  v.optional("gesture", m.gesture);
  v.required("entities", m.entities);
  v.required("mine", m.mine);
  v.required("undone", m.undone);
}
template <class V>
void describe(V& v, HistoryResult& m) {
  v.required("steps", m.steps);
}
template <class V>
void describe(V& v, GrabResult& m) {
  v.required("id", m.id);
  v.required("idle_ms", m.idle_ms);
}
template <class V>
void describe(V& v, ClearResult& m) {
  v.required("removed", m.removed);
  v.required("revision", m.revision);
}
template <class V>
void describe(V& v, RevisionResult& m) {
  v.required("revision", m.revision);
}

template <class V>
void describe(V& v, QEntry& m) {
  v.required("joint", m.joint);
  v.required("type", m.type);
  v.required("at", m.at);
  v.required("size", m.size);
}
template <class V>
void describe(V& v, FigureResult& m) {
  v.required("id", m.entry.id);
  v.required("entity_revision", m.entity_revision);
  if (V::kReads || !m.entry.template_name.empty()) {
    v.optional("template", m.entry.template_name);
    v.optional("stature", m.entry.stature);
  }
  v.required("document", m.document);
  v.required("q_layout", m.q_layout);
  v.optional("pins", m.entry.pins);
  v.optional("label", m.entry.label);
  v.verbatim("user", m.entry.user);
}
template <class V>
void describe(V& v, FigureSummary& m) {
  v.required("id", m.id);
  if (V::kReads || !m.template_name.empty()) {
    v.optional("template", m.template_name);
    v.optional("stature", m.stature);
  }
  v.required("segments", m.segments);
  v.required("entity_revision", m.entity_revision);
}
template <class V>
void describe(V& v, FigureListResult& m) {
  v.required("figures", m.figures);
}

template <class V>
void describe(V& v, GoalResult& m) {
  v.required("id", m.goal.id);
  describe_goal(v, m.goal);
  v.required("entity_revision", m.entity_revision);
  v.optional("held_by", m.held_by);
}
template <class V>
void describe(V& v, GoalListResult& m) {
  v.required("goals", m.goals);
}
template <class V>
void describe(V& v, ObjectResult& m) {
  v.required("id", m.object.id);
  describe_object(v, m.object);
  v.required("entity_revision", m.entity_revision);
}
template <class V>
void describe(V& v, ObjectListResult& m) {
  v.required("objects", m.objects);
}
template <class V>
void describe(V& v, BindingResult& m) {
  v.required("id", m.binding.id);
  describe_binding(v, m.binding);
  v.required("entity_revision", m.entity_revision);
}
template <class V>
void describe(V& v, BindingListResult& m) {
  v.required("bindings", m.bindings);
}

template <class V>
void describe(V& v, CameraResult& m) {
  v.required("id", m.camera.id);
  describe_camera(v, m.camera);
  v.required("entity_revision", m.entity_revision);
}
template <class V>
void describe(V& v, CameraListResult& m) {
  v.required("cameras", m.cameras);
}

template <class V>
void describe(V& v, JointResult& m) {
  v.required("figure", m.figure);
  v.required("joint", m.joint);
  v.required("type", m.type);
  v.required("value", m.value);
  v.optional("halfplane", m.halfplane);
  v.optional("deviation", m.deviation);
  v.optional("twist", m.twist);
  v.optional("hold", m.hold);
}

template <class V>
void describe(V& v, GoalFrame& m) {
  v.required("id", m.id);
  v.required("touch", m.touch);
  v.required("target", m.target);
  v.required("error", m.error);
  v.required("force", m.force);
  v.required("state", m.state);
  v.required("causes", m.causes);
}
template <class V>
void describe(V& v, FigurePose& m) {
  v.required("figure", m.figure);
  v.optional("world_from_segment", m.world_from_segment);
  v.optional("q", m.q);
  if (V::kReads || !m.goals.empty()) v.optional("goals", m.goals);
  v.required("cost", m.cost);
  v.required("status", m.status);
  v.required("branch_changed", m.branch_changed);
}
template <class V>
void describe(V& v, ObjectFrame& m) {
  v.required("object", m.object);
  v.required("world_from_object", m.world_from_object);
}
template <class V>
void describe(V& v, PoseData& m) {
  v.required("t_ns", m.t_ns);
  v.required("revision", m.revision);
  v.required("figures", m.figures);
  if (V::kReads || !m.objects.empty()) v.optional("objects", m.objects);
}

template <class V>
void describe(V& v, PoseResult& m) {
  v.required("figure", m.pose.figure);
  v.required("t_ns", m.t_ns);
  v.required("revision", m.revision);
  v.required("q", m.pose.q);
  v.required("world_from_segment", m.pose.world_from_segment);
  v.required("goals", m.pose.goals);
  v.required("cost", m.pose.cost);
  v.required("status", m.pose.status);
  v.required("branch_changed", m.pose.branch_changed);
  v.required("iterations", m.iterations);
  v.required("chain_solves", m.chain_solves);
  v.required("method", m.method);
  v.required("notes", m.notes);
  v.required("balance_error", m.balance_error);
  v.required("solve_us", m.solve_us);
}

template <class V>
void describe(V& v, SolverResult& m) {
  v.required("method", m.method);
  v.required("iterations", m.iterations);
  v.required("branch_iterations", m.branch_iterations);
}
template <class V>
void describe(V& v, Error& m) {
  v.required("code", m.code);
  v.required("message", m.message);
  v.optional("path", m.path);
  v.optional("hint", m.hint);
}
template <class V>
void describe(V& v, SolveResult& m) {
  v.optional("q", m.q);
  v.optional("world_from_segment", m.world_from_segment);
  v.optional("goals", m.goals);
  v.required("cost", m.cost);
  v.required("status", m.status);
  v.required("branch_changed", m.branch_changed);
  v.required("iterations", m.iterations);
  v.required("method", m.method);
  v.required("notes", m.notes);
  v.required("solve_us", m.solve_us);
}
template <class V>
void describe(V& v, Solved& m) {
  if constexpr (V::kReads) {
    if (v.has("error")) m.error.emplace();
  }
  if (m.error)
    v.required("error", *m.error);
  else
    describe(v, m.result);
}
template <class V>
void describe(V& v, SolveBatchResult& m) {
  v.required("results", m.results);
}
template <class V>
void describe(V& v, SceneResult& m) {
  v.required("revision", m.revision);
  v.required("document", m.document);
}
template <class V>
void describe(V& v, SceneListResult& m) {
  v.required("saved", m.saved);
  v.required("templates", m.templates);
}

template <class V>
void describe(V& v, SubscribeResult& m) {
  v.required("stream", m.stream);
}

template <class V>
void describe(V& v, SensorData& m) {
  v.required("sensor", m.sensor);
  v.required("position", m.position);
  v.required("quat_xyzw", m.rotation);
  v.required("buttons", m.buttons);
  v.required("flags", m.flags);
  v.required("device_count", m.device_count);
  v.required("device_t_ns", m.device_t_ns);
}
template <class V>
void describe(V& v, CameraFrame& m) {
  v.required("camera", m.camera);
  v.required("position", m.world_from_camera.position);
  v.required("quat_xyzw", m.world_from_camera.rotation);
  v.required("fov_y", m.fov_y);
}
template <class V>
void describe(V& v, CameraData& m) {
  v.required("t_ns", m.t_ns);
  v.required("cameras", m.cameras);
}
template <class V>
void describe(V& v, TrackerData& m) {
  v.required("t_ns", m.t_ns);
  if (V::kReads || m.sample_t_ns != 0) v.optional("sample_t_ns", m.sample_t_ns);
  v.required("device", m.device);
  v.required("sensors", m.sensors);
}
template <class V>
void describe(V& v, StatsData& m) {
  v.required("t_ns", m.t_ns);
  v.required("frames", m.frames);
  v.required("solves", m.solves);
  v.required("solve_us", m.solve_us);
  v.required("sample_to_send_us", m.sample_to_send_us);
  v.required("connections", m.connections);
  v.required("dropped", m.dropped);
  v.required("frame_age_us", m.frame_age_us);
  v.required("frame_age_p99_us", m.frame_age_p99_us);
  v.required("acked_age_us", m.acked_age_us);
  v.required("acked_age_p99_us", m.acked_age_p99_us);
  v.optional("trackers", m.trackers);
}

}  // namespace posed::proto
