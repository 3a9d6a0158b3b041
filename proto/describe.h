// Private to the codec: the fields of every message, once, for reading and for writing. A visitor is a Reader or a
// Writer.
#pragma once

#include "proto/describe_bindings.h"
#include "proto/describe_trackers.h"
#include "proto/read.h"
#include "proto/write.h"

namespace posed::proto {

// An edit among several; in methods.cpp.
void read(ReadContext& c, const Json& j, Edit& out);
Json write(const Edit& edit);

struct RawJson {
  Json json;
};
inline void read(ReadContext&, const Json& j, RawJson& out) {
  out.json = j;
}

template <class M, class... Messages>
concept OneOf = (std::is_same_v<M, Messages> || ...);

// ---- vocabulary ----

template <class V>
void describe(V& v, Software& m) {
  v.required("name", m.name);
  v.optional("version", m.version);
}

template <class V>
void describe(V& v, Site& m) {
  v.required("segment", m.segment);
  v.required("point", m.point);
}

template <class V>
void describe(V& v, Joint& m) {
  v.required("name", m.name);
  v.required("type", m.type);
  v.required("position", m.parent_from_joint.position);
  v.optional("quat_xyzw", m.parent_from_joint.rotation);
  v.optional("axes", m.axes);
  v.optional("limits", m.limits);
  v.optional("swing", m.swing);
  v.optional("twist", m.twist);
  if (V::kReads || m.bend_axis != kZero) v.optional("bend_axis", m.bend_axis);
}

template <class V>
void describe(V& v, Segment& m) {
  v.required("name", m.name);
  v.optional("parent", m.parent);
  v.required("joint", m.joint);
  v.required("touch_point", m.touch_point);
  v.optional("shape", m.shapes);
  v.optional("mass", m.mass);
}

template <class V>
void describe(V& v, FigureDocument& m) {
  std::string format = "posed.figure/1";
  v.required("format", format);
  if (format != "posed.figure/1")
    v.fail_at("format", "bad_figure", "the format is not known", "use \"posed.figure/1\"");
  v.required("root", m.root);
  v.required("segments", m.segments);
  v.optional("lever", m.lever);
  v.optional("sites", m.sites);
  v.optional("mirror", m.mirror);
  v.optional("aliases", m.aliases);
}

// ---- scene documents: the id is the key of the map ----

template <class V>
void describe(V& v, OrientationTarget& m) {
  v.required("quat_xyzw", m.rotation);
}
template <class V>
void describe(V& v, AimTarget& m) {
  v.required("axis", m.axis);
  v.optional("point", m.point);
  v.optional("direction", m.direction);
}
template <class V>
void describe(V& v, PlaneTarget& m) {
  v.required("point", m.point);
  v.required("normal", m.normal);
  v.optional("side", m.side);
}
template <class V>
void describe(V& v, LineTarget& m) {
  v.required("point", m.point);
  v.required("direction", m.direction);
}
template <class V>
void describe(V& v, DistanceTarget& m) {
  v.required("to", m.to);
  v.required("length", m.length);
  v.optional("compare", m.compare);
}
template <class V>
void describe(V& v, BalanceTarget& m) {
  v.required("support", m.support);
  v.optional("margin", m.margin);
}
template <class V>
void describe(V& v, PostureTarget& m) {
  v.optional("pose", m.pose);
  v.optional("joints", m.joints);
}

template <class V>
void describe_payload(V& v, PayloadEdit& m) {
  v.optional("position", m.position);
  v.optional("orientation", m.orientation);
  v.optional("aim", m.aim);
  v.optional("plane", m.plane);
  v.optional("line", m.line);
  v.optional("distance", m.distance);
  v.optional("balance", m.balance);
  v.optional("posture", m.posture);
}

template <class V>
void describe_goal(V& v, Goal& m) {
  PayloadEdit payload;
  if constexpr (!V::kReads) payload = spelled_out(m.payload);
  v.required("figure", m.figure);
  v.optional("kind", payload.kind);
  v.optional("at", m.at);
  describe_payload(v, payload);
  v.optional("relative_to", m.relative_to);
  v.optional("weight", m.weight);
  v.optional("priority", m.priority);
  v.optional("tolerance", m.tolerance);
  v.optional("enabled", m.enabled);
  v.optional("label", m.label);
  v.verbatim("user", m.user);
  if constexpr (V::kReads) {
    Result<GoalPayload> made = payload_after(nullptr, payload);
    if (made)
      m.payload = std::move(*made);
    else
      v.fail_below(made.error());
  }
}
template <class V>
void describe(V& v, Goal& m) {
  describe_goal(v, m);
}

template <class V>
void describe_object(V& v, Object& m) {
  v.required("position", m.world_from_object.position);
  v.optional("quat_xyzw", m.world_from_object.rotation);
  v.optional("shape", m.shapes);
  v.optional("label", m.label);
  v.verbatim("user", m.user);
}
template <class V>
void describe(V& v, Object& m) {
  describe_object(v, m);
}

template <class V>
void describe(V& v, Pin& m) {
  v.required("hold", m.hold);
  v.optional("position", m.position);
  v.optional("quat_xyzw", m.rotation);
}

template <class V>
void describe(V& v, FigureEntry& m) {
  if (V::kReads || !m.template_name.empty()) {
    v.optional("template", m.template_name);
    v.optional("stature", m.stature);
  }
  v.optional("document", m.document);
  v.optional("q", m.q);
  v.optional("pins", m.pins);
  v.optional("label", m.label);
  v.verbatim("user", m.user);
}

template <class V>
void describe(V& v, SceneDocument& m) {
  std::string format = "posed.scene/1";
  v.required("format", format);
  if (format != "posed.scene/1") v.fail_at("format", "bad_scene", "the format is not known", "use \"posed.scene/1\"");
  v.required("figures", m.figures);
  v.required("goals", m.goals);
  if constexpr (V::kReads)
    v.optional("objects", m.objects);
  else
    v.required("objects", m.objects);
  v.required("bindings", m.bindings);
  if constexpr (V::kReads)
    v.optional("cameras", m.cameras);
  else
    v.required("cameras", m.cameras);
}

// ---- requests ----

template <class V>
void describe(V& v, SessionHello& m) {
  v.optional("protocol", m.protocol);
  if (m.protocol != kProtocol) v.fail_at("protocol", "not_available", "only protocol 1 is spoken here", "use 1");
  v.optional("client", m.client);
  v.optional("user", m.user);
  v.optional("token", m.token);
  v.optional("resume", m.resume);
  if (m.resume.size() > kMaxResumeBytes)
    v.fail_at("resume", "out_of_range", "the key is too long", "say what session.hello has replied, or leave it out");
}

// What has no fields.
template <class V, class M>
requires OneOf<M, SessionPing, SessionStatus, SessionList, FigureList, GoalList, ObjectList, BindingList, CameraList,
               SolverGet, SceneGet, SceneList, TrackerList, EditRedo, EmptyResult>
void describe(V&, M&) {}

template <class V>
void describe(V& v, FigureSet& m) {
  v.required("id", m.id);
  v.optional("template", m.template_name);
  v.optional("stature", m.stature);
  v.optional("document", m.document);
  v.optional("label", m.label);
  v.verbatim("user", m.user);
}

template <class V, class M>
requires OneOf<M, FigureGet, FigureRemove, GoalGet, GoalRemove, ObjectGet, ObjectRemove, BindingGet, BindingRemove,
               CameraGet, CameraRemove>
void describe(V& v, M& m) {
  v.required("id", m.id);
}

template <class V>
void describe(V& v, FigurePin& m) {
  v.optional("figure", m.figure);
  v.required("segment", m.segment);
  v.required("hold", m.hold);
}

template <class V>
void describe(V& v, GoalSet& m) {
  v.optional("id", m.edit.id);
  v.optional("figure", m.edit.figure);
  v.optional("kind", m.edit.kind);
  v.optional("at", m.edit.at);
  describe_payload(v, m.edit);
  v.optional("relative_to", m.edit.relative_to);
  v.optional("weight", m.edit.weight);
  v.optional("priority", m.edit.priority);
  v.optional("tolerance", m.edit.tolerance);
  v.optional("enabled", m.edit.enabled);
  v.optional("label", m.edit.label);
  v.verbatim("user", m.edit.user);
}

template <class V>
void describe(V& v, GoalClear& m) {
  v.optional("figure", m.figure);
}

template <class V>
void describe(V& v, ObjectSet& m) {
  v.required("id", m.edit.id);
  v.optional("position", m.edit.position);
  v.optional("quat_xyzw", m.edit.rotation);
  v.optional("shape", m.edit.shapes);
  v.optional("label", m.edit.label);
  v.verbatim("user", m.edit.user);
}

// true, or a weight; false lets go, as null does.
inline void read(ReadContext& c, const Json& j, JointHold& out) {
  out = {};
  if (j.is_number()) return read(c, j, out.weight.emplace());
  if (j != true)
    c.fail("wrong_type", "true, a weight or null was expected", "true holds before all goals; null lets go");
}
inline Json write(const JointHold& hold) {
  return hold.weight ? Json(*hold.weight) : Json(true);
}
inline void read(ReadContext& c, const Json& j, Patched<JointHold>& out) {
  if (j.is_null() || j == false) return void(out = Patched<JointHold>::reset());
  JointHold hold;
  read(c, j, hold);
  out = hold;
}

template <class V>
void describe(V& v, JointSet& m) {
  v.optional("figure", m.figure);
  v.required("joint", m.joint);
  v.optional("value", m.value);
  v.optional("halfplane", m.halfplane);
  v.optional("deviation", m.deviation);
  v.optional("twist", m.twist);
  v.optional("hold", m.hold);
}

template <class V>
void describe(V& v, JointGet& m) {
  v.optional("figure", m.figure);
  v.required("joint", m.joint);
}

template <class V>
void describe(V& v, PoseGet& m) {
  v.optional("figure", m.figure);
  v.optional("min_revision", m.min_revision);
  v.optional("wait_ms", m.wait_ms);
  if (m.wait_ms < 0 || m.wait_ms > 10'000)
    v.fail_at("wait_ms", "out_of_range", "the wait is too long", "0 to 10000 ms");
}

template <class V>
void describe(V& v, PoseSet& m) {
  v.optional("figure", m.figure);
  v.required("q", m.q);
}

template <class V>
void describe(V& v, PoseReset& m) {
  v.optional("figure", m.figure);
  v.optional("to", m.to);
  if (m.to != "rest" && m.to != "start") v.fail_at("to", "invalid_params", "no pose is called that", "rest or start");
}

template <class V>
void describe(V& v, PoseMirror& m) {
  v.optional("figure", m.figure);
}

template <class V>
void describe(V& v, SolverSet& m) {
  v.optional("method", m.method);
  v.optional("iterations", m.iterations);
  v.optional("branch_iterations", m.branch_iterations);
}

template <class V>
void describe_setting(V& v, ProblemSetting& m) {
  v.optional("figure", m.figure);
  v.optional("pins", m.pins);
  v.optional("start", m.start);
  v.optional("deadline_us", m.deadline_us);
  if (m.deadline_us && (*m.deadline_us < 1 || *m.deadline_us > kMaxDeadlineUs))
    v.fail_at("deadline_us", "out_of_range", "the deadline is out of range", "1 to 10000000 microseconds");
  v.optional("method", m.method);
}
template <class V>
void describe(V& v, Problem& m) {
  describe_setting(v, m);
  v.required("goals", m.goals);
  if (m.goals.size() > kMaxProblemGoals)
    v.fail_at("goals", "too_large", "the problem has too many goals", "at most 200");
}
template <class V>
void describe(V& v, Solve& m) {
  describe(v, static_cast<Problem&>(m));
  v.optional("fields", m.fields);
}
template <class V>
void describe(V& v, SolveBatch& m) {
  describe_setting(v, m);
  v.required("problems", m.problems);
  if (m.problems.size() > kMaxProblems)
    v.fail_at("problems", "too_large", "the batch has too many problems", "at most 10000; send it in parts");
  v.optional("fields", m.fields);
  v.optional("progress", m.progress);
}

template <class V>
void describe(V& v, SceneNew& m) {
  v.optional("template", m.template_name);
}

template <class V, class M>
requires OneOf<M, SceneSave, SceneOpen, SceneRemove>
void describe(V& v, M& m) {
  v.required("name", m.name);
}

template <class V, class M>
requires OneOf<M, GoalGrab, GoalRelease>
void describe(V& v, M& m) {
  v.required("id", m.id);
  if (V::kReads || m.force) v.optional("force", m.force);
}

template <class V>
void describe(V& v, EditApply& m) {
  v.required("edits", m.edits);
  if (m.edits.size() > kMaxEdits) v.fail_at("edits", "too_large", "there are too many edits", "at most 1000");
  v.optional("label", m.label);
}
template <class V>
void describe(V& v, EditUndo& m) {
  if (V::kReads || m.step > 0) v.optional("step", m.step);
}
template <class V>
void describe(V& v, EditHistory& m) {
  v.optional("limit", m.limit);
  if (m.limit < 1 || m.limit > static_cast<int>(kMaxHistory))
    v.fail_at("limit", "out_of_range", "the number of steps is out of range", "1 to 1000");
}

template <class V>
void describe(V& v, StreamSubscribe& m) {
  v.required("stream", m.stream);
  v.optional("figures", m.figures);
  v.optional("fields", m.fields);
  v.optional("max_rate_hz", m.max_rate_hz);
  if (m.max_rate_hz < 0) v.fail_at("max_rate_hz", "out_of_range", "a rate is not negative", "0 means no cap");
  v.optional("credit", m.credit);
  if (m.credit < 0 || m.credit > 1000)
    v.fail_at("credit", "out_of_range", "credit is a number of frames", "1 to 1000; 0 means none");
  v.optional("encoding", m.encoding);
}

template <class V>
void describe(V& v, StreamUnsubscribe& m) {
  v.required("stream", m.stream);
}

template <class V>
void describe(V& v, StreamAck& m) {
  v.required("stream", m.stream);
  v.required("seq", m.seq);
}

// A problem that can not be read spoils none of the others.
inline void read(ReadContext& c, const Json& j, ProblemEntry& out) {
  ReadContext own;
  own.path = c.path;
  own.strict = c.strict;
  read(own, j, out.problem);
  if (!own.error) return;
  out = {{}, std::move(own.error), j.dump()};
}
inline Json write(const ProblemEntry& e) {
  return e.error ? Json::parse(e.unread, nullptr, false) : write(e.problem);
}

inline void read(ReadContext& c, const Json& j, FigureChoice& out) {
  out = {};
  if (j.is_string()) return read(c, j, out.id);
  if (!j.is_object()) {
    return c.fail("wrong_type", "a figure was expected",
                  R"("body", {"template":"tempus","stature":1.75} or {"format":"posed.figure/1",…})");
  }
  if (j.contains("format")) return read(c, j, out.document.emplace());
  Reader r(c, j);
  r.required("template", out.template_name);
  r.optional("stature", out.stature);
  r.finish();
}
inline Json write(const FigureChoice& f) {
  if (f.document) return write(*f.document);
  return f.template_name.empty() ? Json(f.id) : Json{{"template", f.template_name}, {"stature", f.stature}};
}

}  // namespace posed::proto
