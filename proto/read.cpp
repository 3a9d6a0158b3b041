#include "proto/read.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "common/names.h"
#include "proto/write.h"

namespace posed::proto {
namespace {

template <class T>
void read_integer(ReadContext& c, const Json& j, T& out) {
  const bool fits_signed = j.is_number_integer() && !j.is_number_unsigned();
  if (!j.is_number_integer()) return c.fail("wrong_type", "an integer was expected");
  const bool bad = fits_signed ? !std::in_range<T>(j.get<std::int64_t>()) : !std::in_range<T>(j.get<std::uint64_t>());
  if (bad) return c.fail("out_of_range", "the number is out of range");
  out = fits_signed ? static_cast<T>(j.get<std::int64_t>()) : static_cast<T>(j.get<std::uint64_t>());
}

// Exactly `n` finite numbers.
bool read_numbers(ReadContext& c, const Json& j, std::span<double> out, const char* shape) {
  if (!j.is_array() || j.size() != out.size()) {
    c.fail("wrong_type", std::string("an array of ") + std::to_string(out.size()) + " numbers was expected", shape);
    return false;
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    const At at(c, std::to_string(i));
    read(c, j[i], out[i]);
  }
  return !c.error;
}

bool unit(ReadContext& c, Quat& q) {
  const double length = glm::length(q);
  if (std::abs(length - 1.0) > 1e-3) {
    c.fail("invalid_params", "the quaternion is not of unit length", "x y z w, with x²+y²+z²+w² = 1");
    return false;
  }
  if (std::abs(length - 1.0) > 1e-15) q = q / length;  // else kept to the last digit
  return true;
}

}  // namespace

bool expect_object(ReadContext& c, const Json& j) {
  if (!j.is_object()) c.fail("wrong_type", "an object was expected", "{…}");
  return j.is_object();
}

bool expect_array(ReadContext& c, const Json& j) {
  if (!j.is_array()) c.fail("wrong_type", "an array was expected", "[…]");
  return j.is_array();
}

void read(ReadContext& c, const Json& j, bool& out) {
  if (!j.is_boolean()) return c.fail("wrong_type", "true or false was expected");
  out = j.get<bool>();
}
void read(ReadContext& c, const Json& j, int& out) {
  read_integer(c, j, out);
}
void read(ReadContext& c, const Json& j, std::uint32_t& out) {
  read_integer(c, j, out);
}
void read(ReadContext& c, const Json& j, std::uint64_t& out) {
  read_integer(c, j, out);
}
void read(ReadContext& c, const Json& j, std::int64_t& out) {
  read_integer(c, j, out);
}

void read(ReadContext& c, const Json& j, double& out) {
  if (!j.is_number()) return c.fail("wrong_type", "a number was expected");
  const double value = j.get<double>();
  if (!std::isfinite(value)) return c.fail("not_finite", "the number is not finite");
  out = value;
}

void read(ReadContext& c, const Json& j, std::string& out) {
  if (!j.is_string()) return c.fail("wrong_type", "a string was expected");
  out = j.get<std::string>();
  if (out.size() > 4096) c.fail("out_of_range", "the string is too long", "at most 4096 bytes");
}

void read(ReadContext& c, const Json& j, Vec3& out) {
  double v[3];
  if (read_numbers(c, j, v, "[x,y,z] in metres")) out = {v[0], v[1], v[2]};
}

void read(ReadContext& c, const Json& j, Quat& out) {
  double v[4];
  if (!read_numbers(c, j, v, "[x,y,z,w]")) return;
  Quat q = quat_from_xyzw(v);
  if (unit(c, q)) out = q;
}

void read(ReadContext& c, const Json& j, Transform& out) {
  double v[7];
  if (!read_numbers(c, j, v, "[x,y,z,qx,qy,qz,qw]")) return;
  Quat q = quat_from_xyzw(std::span<const double>(v + 3, 4));
  if (unit(c, q)) out = {{v[0], v[1], v[2]}, q};
}

void read(ReadContext& c, const Json& j, Attachment& out) {
  out = {};
  if (j.is_string()) {
    const auto text = j.get<std::string>();
    if (text.empty()) return c.fail("unknown_segment", "the place names no segment", "\"right_hand\"");
    const std::size_t slash = text.find('/');
    out.segment = text.substr(0, slash);
    if (slash != std::string::npos) out.site = text.substr(slash + 1);
    return;
  }
  if (!j.is_object()) {
    return c.fail("wrong_type", "a place on the figure was expected",
                  R"("right_hand", "right_hand/fingertip" or {"segment":"right_hand","point":[x,y,z]})");
  }
  Reader reader(c, j);
  reader.required("segment", out.segment);
  Vec3 point{0.0, 0.0, 0.0};
  reader.required("point", point);
  reader.finish();
  out.point = point;
}

void read(ReadContext& c, const Json& j, Shape& out) {
  if (!expect_object(c, j)) return;
  Reader r(c, j);
  r.required("kind", out.kind);
  if (out.kind == Shape::Kind::capsule) {
    r.required("from", out.a);
    r.required("to", out.b);
    r.required("radius", out.radius);
  } else {
    r.required("center", out.a);
    r.required(out.kind == Shape::Kind::box ? "half_size" : "radii", out.b);
  }
  r.finish();
}

void read(ReadContext& c, const Json& j, Limit& out) {
  double v[2];
  if (read_numbers(c, j, v, "as in [0.1,1.2]")) out = {v[0], v[1]};
}

void read(ReadContext& c, const Json& j, Swing& out) {
  if (!expect_object(c, j)) return;
  out = {};
  if (j.contains("ellipse") == j.contains("polygon"))
    return c.fail("invalid_params", "a swing is either an ellipse or a polygon", R"("ellipse":[0.8,0.5])");
  Reader r(c, j);
  if (r.has("polygon")) {
    out.kind = Swing::Kind::polygon;
    r.required("polygon", out.corners);
  } else {
    Limit radii;  // two numbers
    r.required("ellipse", radii);
    out.radii = {radii.min, radii.max};
    r.optional("center", out.center);
  }
  r.finish();
}

void read(ReadContext& c, const Json& j, GoalBase& out) {
  out = {};
  if (j == "world") return;
  constexpr const char* kHint =
      R"("world", {"figure":"body","segment":"head"}, {"object":"chair"} or {"sensor":"liberty:1"})";
  if (!j.is_object())
    return c.fail("invalid_params", "it is relative to the world, a segment, an object or a sensor", kHint);
  Reader r(c, j);
  const bool object = r.optional("object", out.object);
  const bool figure = r.optional("figure", out.figure), segment = r.optional("segment", out.segment);
  const bool sensor = r.optional("sensor", out.sensor);
  out.kind = sensor ? GoalBase::Kind::sensor : object ? GoalBase::Kind::object : GoalBase::Kind::segment;
  if (sensor + object + (figure || segment) > 1) r.fail("invalid_params", "it is relative to one thing", kHint);
  if (!sensor && !object && !segment) r.fail_at("segment", "missing_field", "the field \"segment\" is missing", kHint);
  r.finish();
}

void read(ReadContext& c, const Json& j, GoalWeight& out) {
  out = {};
  if (j.is_number()) return read(c, j, out.value);
  if (!j.is_object())
    return c.fail("wrong_type", "a number was expected", R"(10; of a pose goal also {"position":10,"orientation":2})");
  Reader r(c, j);
  r.required("position", out.value);
  r.required("orientation", out.orientation.emplace());
  r.finish();
}

void read(ReadContext& c, const Json& j, GoalTolerance& out) {
  out = {};
  if (j.is_array()) return read(c, j, out.box.emplace());
  if (!j.is_number()) return c.fail("wrong_type", "a number was expected", "0.01; of a position also [0.01,0.01,0.2]");
  read(c, j, out.radius);
}

void read(ReadContext& c, const Json& j, JointValue& out) {
  out = {};
  if (j.is_number()) return read(c, j, out.share.emplace_back());
  if (j.is_array()) return read(c, j, out.share);
  if (!j.is_object()) {
    return c.fail("wrong_type", "a joint's value was expected",
                  R"(a number, its share of q as an array, or {"halfplane":…,"deviation":…,"twist":…})");
  }
  Reader r(c, j);
  r.optional("halfplane", out.halfplane);
  r.optional("deviation", out.deviation);
  r.optional("twist", out.twist);
  r.finish();
}

void read(ReadContext& c, const Json& j, Axes& out) {
  if (!expect_array(c, j)) return;
  bool named[6] = {};
  constexpr const char* kNames[] = {"x", "y", "z", "rx", "ry", "rz"};
  for (const Json& item : j) {
    const auto* const found = std::find(std::begin(kNames), std::end(kNames), item);
    if (found == std::end(kNames))
      return c.fail("invalid_params", "an axis is one of x y z rx ry rz", "as in [\"x\",\"y\",\"z\"]");
    named[found - kNames] = true;
  }
  out = {named[0], named[1], named[2], named[3], named[4], named[5]};
}

void read(ReadContext& c, const Json& j, Start& out) {
  out = {};
  if (j.is_string() && j != "q") return read(c, j, out.kind);
  if (!j.is_object()) return c.fail("wrong_type", "a start was expected", R"("rest", "current" or {"q":[…]})");
  out.kind = Start::Kind::q;
  Reader r(c, j);
  r.required("q", out.q);
  r.finish();
}

void read(ReadContext& c, const Json& j, GoalFrame::Because& out) {
  if (!expect_object(c, j)) return;
  Reader r(c, j);
  r.optional("goal", out.goal);
  r.optional("beyond_m", out.beyond_m);
  r.optional("limit", out.limit);
  r.optional("side", out.side);
  r.optional("pin", out.pin);
  r.optional("binding", out.binding);
  r.optional("figure", out.figure);
  r.finish();
}

void read(ReadContext& c, const Json& j, std::pair<std::string, std::string>& out) {
  if (!j.is_array() || j.size() != 2)
    return c.fail("wrong_type", "a pair of names was expected", R"(["left_hand","right_hand"])");
  read(c, j[0], out.first);
  read(c, j[1], out.second);
}

void Reader::verbatim(const char* key, std::string& text) {
  known_.push_back(key);
  const auto found = object_.find(key);
  if (found == object_.end()) return;
  text = found->dump();
  const auto deepest = [](const auto& self, const Json& j) -> int {
    int depth = 0;
    if (j.is_structured()) {
      depth = 1;
      for (const Json& item : j) depth = std::max(depth, self(self, item) + 1);
    }
    return depth;
  };
  // It is sent inside larger documents, which must stay within the depth that peers accept.
  if (deepest(deepest, *found) > 16) fail_at(key, "out_of_range", "it nests too deeply", "at most 16 levels");
  if (text.size() > 4096) fail_at(key, "out_of_range", "it is too long", "at most 4096 bytes");
}

void Reader::verbatim(const char* key, Patched<std::string>& text) {
  if (has(key) && object_.find(key)->is_null()) {
    known_.push_back(key);
    text = Patched<std::string>::reset();
    return;
  }
  std::string value;
  verbatim(key, value);
  if (!value.empty()) text = Patched(std::move(value));
}

void Reader::reserved(const char* key, const char* allowed) {
  known_.push_back(key);
  const auto found = object_.find(key);
  if (found == object_.end() || found->is_null() || (allowed && *found == Json::parse(allowed))) return;
  fail_at(key, "not_available", std::string("\"") + key + "\" is reserved: this daemon does not do it yet",
          allowed ? std::string("leave it out, or say ") + allowed : "leave it out");
}

void Reader::finish() {
  if (!context_.strict || context_.error) return;
  for (const auto& [key, value] : object_.items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const At at(context_, key.substr(0, 64));
    return context_.fail("unknown_field", "there is no field \"" + key.substr(0, 64) + "\" here",
                         did_you_mean(key, known_));
  }
}

}  // namespace posed::proto
