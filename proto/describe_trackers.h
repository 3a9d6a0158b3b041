// Private to the codec: the fields of what is said of trackers: leases, settings, calibrations.
#pragma once

#include "proto/read.h"
#include "proto/write.h"

namespace posed::proto {

template <class V>
void describe(V& v, AlignedPoint& m) {
  v.required("source", m.source);
  v.required("world", m.world);
  if (V::kReads || m.residual_m > 0.0) v.optional("residual_m", m.residual_m);
}
template <class V>
void describe(V& v, TipOffset& m) {
  v.required("offset", m.offset);
  v.required("residual_m", m.residual_m);
  v.required("samples", m.samples);
}
template <class V>
void describe(V& v, SensorCalibration& m) {
  v.optional("tip", m.tip);
  v.optional("boresight", m.boresight);
}
template <class V>
void describe(V& v, Calibration& m) {
  v.required("tracker", m.tracker);
  v.required("name", m.name);
  v.required("utc_ns", m.utc_ns);
  v.required("author", m.author);
  v.required("world_from_source", m.world_from_source);
  v.required("residual_m", m.residual_m);
  v.required("points", m.points);
  v.required("sensors", m.sensors);
}

template <class V, class M>
void describe_forced(V& v, M& m) {
  if (V::kReads || m.force) v.optional("force", m.force);
}
template <class V, class M>
void describe_duration(V& v, M& m) {
  v.optional("for_ms", m.for_ms);
  if (m.for_ms < 1 || m.for_ms > kMaxTouchMs)
    v.fail_at("for_ms", "out_of_range", "the time is out of range", "1 to 60000 ms");
}

template <class V, class M>
requires(std::is_same_v<M, TrackerGrab> || std::is_same_v<M, TrackerRelease> ||
         std::is_same_v<M, TrackerReset>) void describe(V& v, M& m) {
  v.required("tracker", m.tracker);
  describe_forced(v, m);
}

inline void read(ReadContext& c, const Json& j, DeviceFilter& out) {
  out = {};
  if (j == "off") return;
  constexpr const char* kHint = R"("off", or {"sensitivity":0.2,"low":0.2,"high":0.8,"max":0.95})";
  if (!j.is_object()) return c.fail("wrong_type", "a filter was expected", kHint);
  Reader r(c, j);
  out.on = true;
  r.required("sensitivity", out.sensitivity);
  r.required("low", out.low);
  r.required("high", out.high);
  r.required("max", out.most);
  r.finish();
  for (const double v : {out.sensitivity, out.low, out.high, out.most}) {
    if (!(v > 0.0 && v < 1.0) && v != 1.0) c.fail("out_of_range", "a filter's numbers lie between 0 and 1", kHint);
  }
}
inline Json write(const DeviceFilter& f) {
  if (!f.on) return "off";
  return Json{{"sensitivity", f.sensitivity}, {"low", f.low}, {"high", f.high}, {"max", f.most}};
}

template <class V>
void describe(V& v, TrackerConfigure& m) {
  v.required("tracker", m.tracker);
  describe_forced(v, m);
  v.optional("calibration", m.calibration);
  v.optional("rate_hz", m.rate_hz);
  v.optional("sensors", m.sensors);
  v.optional("hemisphere", m.hemisphere);
  v.optional("position_filter", m.position_filter);
  v.optional("attitude_filter", m.attitude_filter);
}

template <class V>
void describe(V& v, TrackerTouch& m) {
  v.required("sensor", m.sensor);
  describe_forced(v, m);
  describe_duration(v, m);
  v.optional("point", m.point);
}
template <class V>
void describe(V& v, TrackerAlign& m) {
  v.required("tracker", m.tracker);
  v.optional("name", m.name);
  describe_forced(v, m);
  v.required("points", m.points);
  if (m.points.size() > kMaxAlignPoints) v.fail_at("points", "too_large", "there are too many points", "3 to 1000");
}
template <class V>
void describe(V& v, TrackerTip& m) {
  v.required("sensor", m.sensor);
  v.optional("name", m.name);
  describe_forced(v, m);
  describe_duration(v, m);
  v.optional("offset", m.offset);
}
template <class V>
void describe(V& v, TrackerBoresight& m) {
  v.required("sensor", m.sensor);
  v.optional("name", m.name);
  describe_forced(v, m);
  describe_duration(v, m);
  v.optional("quat_xyzw", m.rotation);
}

template <class V>
void describe(V& v, TrackerForget& m) {
  v.required("tracker", m.tracker);
  v.required("name", m.name);
  describe_forced(v, m);
}

// ---- results ----

template <class V>
void describe(V& v, TrackerEntry& m) {
  v.required("tracker", m.tracker);
  v.required("kind", m.kind);
  v.required("state", m.state);
  v.required("message", m.message);
  v.required("rate_hz", m.rate_hz);
  v.required("frames", m.frames);
  v.required("bad_bytes", m.bad_bytes);
  v.required("sensors", m.sensors);
  v.optional("held_by", m.held_by);
  v.optional("calibration", m.calibration);
  v.optional("calibrations", m.calibrations);
}
template <class V>
void describe(V& v, TrackerListResult& m) {
  v.required("trackers", m.trackers);
}
template <class V>
void describe(V& v, TrackerGrabResult& m) {
  v.required("tracker", m.tracker);
  v.required("idle_ms", m.idle_ms);
}
template <class V>
void describe(V& v, TouchResult& m) {
  v.required("sensor", m.sensor);
  v.required("samples", m.samples);
  v.required("position", m.position);
  v.required("quat_xyzw", m.rotation);
  v.required("source", m.source);
  v.required("spread_m", m.spread_m);
  v.optional("off_m", m.off_m);
}
template <class V>
void describe(V& v, CalibrationResult& m) {
  v.required("calibration", m.calibration);
}
template <class V>
void describe(V& v, TrackerStats& m) {
  v.required("tracker", m.tracker);
  v.required("rate_hz", m.rate_hz);
  v.required("jitter_us", m.jitter_us);
  v.required("lag_us", m.lag_us);
}

}  // namespace posed::proto
