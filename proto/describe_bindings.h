// Private to the codec: the fields of cameras and bindings, in documents and in edits.
#pragma once

#include "proto/read.h"
#include "proto/write.h"

namespace posed::proto {

template <class V>
void describe_camera(V& v, Camera& m) {
  v.required("position", m.base_from_camera.position);
  v.optional("quat_xyzw", m.base_from_camera.rotation);
  v.optional("relative_to", m.relative_to);
  v.optional("fov_y", m.fov_y);
  v.optional("label", m.label);
  v.verbatim("user", m.user);
}
template <class V>
void describe(V& v, Camera& m) {
  describe_camera(v, m);
}

template <class V>
void describe(V& v, BindingTarget& m) {
  v.optional("goal", m.goal);
  v.optional("object", m.object);
  v.optional("camera", m.camera);
  if (V::kReads || !m.joint.empty()) v.optional("figure", m.figure);
  v.optional("joint", m.joint);
  const int named = !m.goal.empty() + !m.object.empty() + !m.camera.empty() + !m.joint.empty();
  constexpr const char* kHint = R"({"goal":"g1"}, {"object":"chair"}, {"camera":"main"} or {"joint":"left_elbow"})";
  if (named > 1) v.fail("invalid_params", "a binding moves one thing", kHint);
  if (named == 0) v.fail("missing_field", "the binding moves nothing", kHint);
  if (!m.figure.empty() && m.joint.empty())
    v.fail_at("figure", "invalid_params", "only a joint is of a figure", "leave it out");
}

template <class V>
void describe(V& v, Clutch& m) {
  v.required("button", m.button);
}
template <class V>
void describe(V& v, ButtonAction& m) {
  v.required("button", m.button);
  v.required("do", m.act);
}
template <class V>
void describe(V& v, SensorOffset& m) {
  v.optional("position", m.position);
  v.optional("quat_xyzw", m.rotation);
}
template <class V>
void describe(V& v, OneEuro& m) {
  v.optional("min_cutoff_hz", m.min_cutoff_hz);
  v.optional("beta", m.beta);
  v.optional("d_cutoff_hz", m.d_cutoff_hz);
}
template <class V>
void describe(V& v, BindingFilter& m) {
  v.optional("one_euro", m.one_euro);
  if (V::kReads || m.predict_ms > 0.0) v.optional("predict_ms", m.predict_ms);
}

template <class V>
void describe_binding(V& v, Binding& m) {
  v.required("sensor", m.sensor);
  v.required("to", m.to);
  v.optional("axes", m.axes);
  v.optional("mode", m.mode);
  v.optional("clutch", m.clutch);
  if (V::kReads || !m.buttons.empty()) v.optional("buttons", m.buttons);
  v.optional("scale", m.scale);
  v.optional("offset", m.offset);
  v.optional("filter", m.filter);
  v.optional("label", m.label);
  v.verbatim("user", m.user);
}
template <class V>
void describe(V& v, Binding& m) {
  describe_binding(v, m);
}

// ---- edits ----

template <class V>
void describe(V& v, BindingSet& m) {
  v.optional("id", m.edit.id);
  v.optional("sensor", m.edit.sensor);
  v.optional("to", m.edit.to);
  v.optional("axes", m.edit.axes);
  v.optional("mode", m.edit.mode);
  v.optional("clutch", m.edit.clutch);
  v.optional("buttons", m.edit.buttons);
  v.optional("scale", m.edit.scale);
  v.optional("offset", m.edit.offset);
  v.optional("filter", m.edit.filter);
  v.optional("label", m.edit.label);
  v.verbatim("user", m.edit.user);
}

template <class V>
void describe(V& v, CameraSet& m) {
  v.required("id", m.edit.id);
  v.optional("position", m.edit.position);
  v.optional("quat_xyzw", m.edit.rotation);
  v.optional("relative_to", m.edit.relative_to);
  v.optional("fov_y", m.edit.fov_y);
  v.optional("label", m.edit.label);
  v.verbatim("user", m.edit.user);
}

}  // namespace posed::proto
