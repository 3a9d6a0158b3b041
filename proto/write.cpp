#include "proto/write.h"

namespace posed::proto {

Json write(const Vec3& v) {
  return Json::array({v.x, v.y, v.z});
}
Json write(const Quat& q) {
  return Json::array({q.x, q.y, q.z, q.w});
}
Json write(const Transform& t) {
  return Json::array(
      {t.position.x, t.position.y, t.position.z, t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w});
}
Json write(const Limit& l) {
  return Json::array({l.min, l.max});
}
Json write(const std::pair<std::string, std::string>& pair) {
  return Json::array({pair.first, pair.second});
}

Json write(const Axes& a) {
  Json j = Json::array();
  if (a.x) j.push_back("x");
  if (a.y) j.push_back("y");
  if (a.z) j.push_back("z");
  if (a.rx) j.push_back("rx");
  if (a.ry) j.push_back("ry");
  if (a.rz) j.push_back("rz");
  return j;
}

Json write(const Attachment& a) {
  if (a.point) return Json{{"segment", a.segment}, {"point", write(*a.point)}};
  return a.site.empty() ? a.segment : a.segment + "/" + a.site;
}

Json write(const Shape& s) {
  Json j{{"kind", word(s.kind)}};
  if (s.kind == Shape::Kind::capsule) {
    j["from"] = write(s.a);
    j["to"] = write(s.b);
    j["radius"] = s.radius;
  } else {
    j["center"] = write(s.a);
    j[s.kind == Shape::Kind::box ? "half_size" : "radii"] = write(s.b);
  }
  return j;
}

Json write(const Swing& s) {
  if (s.kind == Swing::Kind::polygon) return Json{{"polygon", write(s.corners)}};
  Json j{{"ellipse", Json::array({s.radii[0], s.radii[1]})}};
  if (s.center != kZero) j["center"] = write(s.center);
  return j;
}

Json write(const GoalBase& b) {
  if (b.kind == GoalBase::Kind::world) return "world";
  if (b.kind == GoalBase::Kind::sensor) return Json{{"sensor", b.sensor}};
  if (b.kind == GoalBase::Kind::object) return Json{{"object", b.object}};
  Json j = Json::object();
  if (!b.figure.empty()) j["figure"] = b.figure;
  j["segment"] = b.segment;
  return j;
}

Json write(const GoalWeight& w) {
  return w.orientation ? Json{{"position", w.value}, {"orientation", *w.orientation}} : Json(w.value);
}

Json write(const GoalTolerance& t) {
  return t.box ? write(*t.box) : Json(t.radius);
}

Json write(const JointValue& v) {
  if (!v.oriented()) return v.share.size() == 1 ? Json(v.share[0]) : write(v.share);
  Json j = Json::object();
  if (v.halfplane) j["halfplane"] = *v.halfplane;
  if (v.deviation) j["deviation"] = *v.deviation;
  if (v.twist) j["twist"] = *v.twist;
  return j;
}

Json write(const Start& s) {
  return s.kind == Start::Kind::q ? Json{{"q", write(s.q)}} : Json(word(s.kind));
}

Json write(const GoalFrame::Because& b) {
  if (!b.goal.empty()) return Json{{"goal", b.goal}};
  if (!b.binding.empty()) return Json{{"binding", b.binding}};
  if (b.pin.empty() && b.limit.empty()) return Json{{"beyond_m", b.beyond_m}};
  Json j = b.pin.empty() ? Json{{"limit", b.limit}, {"side", word(b.side)}} : Json{{"pin", b.pin}};
  if (!b.figure.empty()) j["figure"] = b.figure;
  return j;
}

}  // namespace posed::proto
