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

Json write(const GoalFrame::Because& b) {
  return b.goal.empty() ? Json{{"beyond_m", b.beyond_m}} : Json{{"goal", b.goal}};
}

}  // namespace posed::proto
