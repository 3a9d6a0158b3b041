#include "server/solver/tempus.h"

#include <string>

namespace posed {
namespace {

constexpr double kDegree = M_PI / 180.0;

// Written for the left side and for a stature of 1; `mirrored` and `scaled` make the rest.
using Limits = std::vector<std::optional<Limit>>;

Limit degrees(double min, double max) {
  return {min * kDegree, max * kDegree};
}

Shape capsule(Vec3 from, Vec3 to, double radius) {
  return {Shape::Kind::capsule, from, to, radius};
}
Shape ellipsoid(Vec3 center, Vec3 radii) {
  return {Shape::Kind::ellipsoid, center, radii, 0.0};
}
Shape box(Vec3 center, Vec3 half_size) {
  return {Shape::Kind::box, center, half_size, 0.0};
}

Segment part(std::string name, std::string parent, Vec3 origin, Vec3 touch, double mass_share) {
  Segment s;
  s.name = std::move(name);
  s.parent = std::move(parent);
  s.joint.parent_from_joint.position = origin;
  s.touch_point = touch;
  s.mass = mass_share;
  return s;
}

void ball(Segment& s, std::string name, Vec3 bend_axis, Limits limits) {
  s.joint.name = std::move(name);
  s.joint.type = JointType::ball;
  s.joint.bend_axis = bend_axis;
  s.joint.limits = std::move(limits);
}

// Where the limb may point, as an ellipse of directions about `center`, and its twist.
void limb(Segment& s, std::string name, Vec3 bend_axis, Vec3 center, std::array<double, 2> radii, Limit twist) {
  ball(s, std::move(name), bend_axis, {});
  Swing swing;
  swing.center = glm::normalize(center);
  swing.radii = {radii[0] * kDegree, radii[1] * kDegree};
  s.joint.swing = swing;
  s.joint.twist = twist;
}

void universal(Segment& s, std::string name, Vec3 first, Vec3 second, Limits limits) {
  ball(s, std::move(name), first, std::move(limits));
  s.joint.type = JointType::universal;
  s.joint.axes = {first, second};
}

std::vector<Segment> trunk() {
  Segment pelvis = part("lower_torso", "", {0, 0, 0.530}, {0, 0, 0}, 0.142);
  pelvis.joint.name = "root";
  pelvis.joint.type = JointType::free;
  pelvis.shapes = {ellipsoid({0, 0, 0.020}, {0.062, 0.092, 0.062})};

  Segment chest = part("upper_torso", "lower_torso", {0, 0, 0.080}, {0, 0, 0.235}, 0.335);
  ball(chest, "waist", kY, {degrees(-35, 35), degrees(-25, 80), degrees(-45, 45)});
  chest.shapes = {ellipsoid({0, 0, 0.055}, {0.056, 0.078, 0.095}), ellipsoid({0, 0, 0.145}, {0.064, 0.096, 0.098})};

  // The range of neck and head together is shared between their two joints.
  Segment neck = part("neck", "upper_torso", {0, 0, 0.235}, {0, 0, 0.070}, 0.020);
  ball(neck, "neck", kY, {degrees(-45, 45), degrees(-22.5, 22.5), degrees(-35, 35)});
  neck.shapes = {capsule({0, 0, 0}, {0, 0, 0.060}, 0.030)};

  Segment head = part("head", "neck", {0, 0, 0.070}, {0, 0, 0.085}, 0.061);
  universal(head, "head", kY, kZ, {degrees(-22.5, 22.5), degrees(-35, 35)});
  head.shapes = {ellipsoid({0.008, 0, 0.020}, {0.055, 0.044, 0.065})};
  return {pelvis, chest, neck, head};
}

std::vector<Segment> left_arm() {
  Segment clavicle = part("left_clavicle", "upper_torso", {0, 0.015, 0.205}, {0, 0.114, 0}, 0.010);
  universal(clavicle, "left_sternoclavicular", -kZ, kX, {degrees(-25, 25), degrees(-10, 30)});
  clavicle.shapes = {capsule({0, 0.010, 0}, {0, 0.100, 0}, 0.026)};

  // The shoulder's 180 of flexion, 60 of extension and 135 across the chest are those of clavicle and upper arm
  // together: of the arm alone all that lies within 100 of a direction forward, outward and a little down.
  Segment upper = part("left_upper_arm", "left_clavicle", {0, 0.114, 0}, {0, 0.186, 0}, 0.028);
  limb(upper, "left_shoulder", -kZ, {0.6, 0.75, -0.28}, {100, 100}, degrees(-90, 70));
  upper.shapes = {capsule({0, 0, 0}, {0, 0.186, 0}, 0.027)};

  Segment lower = part("left_lower_arm", "left_upper_arm", {0, 0.186, 0}, {0, 0.146, 0}, 0.016);
  universal(lower, "left_elbow", -kZ, kY, {degrees(0, 150), degrees(-80, 80)});
  lower.shapes = {capsule({0, 0, 0}, {0, 0.140, 0}, 0.021)};

  Segment hand = part("left_hand", "left_lower_arm", {0, 0.146, 0}, {0, 0.054, 0}, 0.006);
  universal(hand, "left_wrist", -kX, -kZ, {degrees(-70, 80), degrees(-30, 20)});
  hand.shapes = {box({0, 0.054, 0}, {0.024, 0.054, 0.010}), capsule({0.022, 0.020, 0}, {0.038, 0.056, 0}, 0.007)};
  return {clavicle, upper, lower, hand};
}

std::vector<Segment> left_leg() {
  // About the middle of flexion 120 and extension 30, abduction 45 and adduction 30.
  Segment upper = part("left_upper_leg", "lower_torso", {0, 0.052, 0}, {0, 0, -0.245}, 0.100);
  limb(upper, "left_hip", -kY, {0.701, 0.131, -0.701}, {75, 37.5}, degrees(-45, 45));
  upper.shapes = {capsule({0, 0, -0.010}, {0, 0, -0.245}, 0.043)};

  Segment lower = part("left_lower_leg", "left_upper_leg", {0, 0, -0.245}, {0, 0, -0.246}, 0.0465);
  universal(lower, "left_knee", kY, kZ, {degrees(0, 135), degrees(-30, 30)});
  lower.shapes = {capsule({0, 0, 0}, {0, 0, -0.246}, 0.029)};

  // About x: eversion is positive; y: plantar flexion is positive; z: no figure is at hand.
  Segment foot = part("left_foot", "left_lower_leg", {0, 0, -0.246}, {0.114, 0, -0.039}, 0.0145);
  ball(foot, "left_ankle", -kY, {degrees(-35, 15), degrees(-20, 50), std::nullopt});
  foot.shapes = {box({0.038, 0, -0.024}, {0.076, 0.0275, 0.015})};
  return {upper, lower, foot};
}

std::string other_side(const std::string& name) {
  return name.starts_with("left_") ? "right_" + name.substr(5) : name;
}

// Through the plane y = 0. A point turns its y over; an axis of rotation all but its y, so that the limits stay.
Vec3 mirrored_point(const Vec3& p) {
  return {p.x, -p.y, p.z};
}
Vec3 mirrored_axis(const Vec3& a) {
  return {-a.x, a.y, -a.z};
}

std::optional<Limit> negated(const std::optional<Limit>& limit) {
  return limit ? std::optional<Limit>(Limit{-limit->max, -limit->min}) : std::nullopt;
}

Segment mirrored(Segment s) {
  s.name = other_side(s.name);
  s.parent = other_side(s.parent);
  s.joint.name = other_side(s.joint.name);
  s.joint.parent_from_joint.position = mirrored_point(s.joint.parent_from_joint.position);
  s.touch_point = mirrored_point(s.touch_point);
  for (Vec3& axis : s.joint.axes) axis = mirrored_axis(axis);
  s.joint.bend_axis = mirrored_axis(s.joint.bend_axis);
  if (s.joint.type == JointType::ball) {
    // A ball joint's limits are about fixed axes, so two of them turn over instead; its twist is about the limb.
    if (!s.joint.limits.empty()) {
      s.joint.limits[0] = negated(s.joint.limits[0]);
      s.joint.limits[2] = negated(s.joint.limits[2]);
    }
    if (s.joint.swing) s.joint.swing->center = mirrored_point(s.joint.swing->center);
    s.joint.twist = negated(s.joint.twist);
  }
  for (Shape& shape : s.shapes) {
    shape.a = mirrored_point(shape.a);
    if (shape.kind == Shape::Kind::capsule) shape.b = mirrored_point(shape.b);
  }
  return s;
}

void scale(FigureDocument& d, double stature) {
  const double mass = 70.0 * std::pow(stature / 1.75, 3.0);
  for (Segment& s : d.segments) {
    s.joint.parent_from_joint.position *= stature;
    s.touch_point *= stature;
    s.mass *= mass;
    for (Shape& shape : s.shapes) shape.a *= stature, shape.b *= stature, shape.radius *= stature;
  }
  for (auto& entry : d.sites) entry.second.point *= stature;
}

void add_sites(FigureDocument& d) {
  d.sites["head/eyes"] = {"head", {0.055, 0, 0.021}};  // eye height 0.936
  for (const std::string side : {"left", "right"}) {
    const double y = side == "left" ? 1.0 : -1.0;
    d.sites[side + "_hand/fingertip"] = {side + "_hand", {0, y * 0.108, 0}};
    d.sites[side + "_hand/grip"] = {side + "_hand", {0, y * 0.054, -0.016}};  // in front of the palm
    d.sites[side + "_foot/heel"] = {side + "_foot", {-0.038, 0, -0.039}};
  }
}

void add_names(FigureDocument& d) {
  d.aliases = {{"hips", "lower_torso"}, {"spine", "upper_torso"}, {"chest", "upper_torso"}};
  const std::pair<const char*, const char*> vrm[] = {
      {"Shoulder", "clavicle"},  {"UpperArm", "upper_arm"}, {"LowerArm", "lower_arm"}, {"Hand", "hand"},
      {"UpperLeg", "upper_leg"}, {"LowerLeg", "lower_leg"}, {"Foot", "foot"}};
  for (const auto& [bone, segment] : vrm) {
    d.aliases[std::string("left") + bone] = std::string("left_") + segment;
    d.aliases[std::string("right") + bone] = std::string("right_") + segment;
    d.mirror.emplace_back(std::string("left_") + segment, std::string("right_") + segment);
  }
}

}  // namespace

Result<FigureDocument> tempus(double stature) {
  if (!(stature >= kMinStature && stature <= kMaxStature)) {
    return Error{"out_of_range", "a stature is 0.5 to 2.5 m", "/stature", "1.75 is the default"};
  }
  FigureDocument d;
  d.root = "lower_torso";
  d.segments = trunk();
  for (const auto& limb : {left_arm(), left_leg()}) {
    d.segments.insert(d.segments.end(), limb.begin(), limb.end());
    for (const Segment& s : limb) d.segments.push_back(mirrored(s));
  }
  add_sites(d);
  add_names(d);
  scale(d, stature);
  return d;
}

std::vector<double> start_pose(const BodyTree& tree) {
  std::vector<double> q = tree.rest();
  for (const bool left : {true, false}) {
    const auto shoulder = tree.find_joint(left ? "left_shoulder" : "right_shoulder");
    if (!shoulder || tree.joint(*shoulder).type != JointType::ball) continue;
    const auto down = xyzw(quat_about(kX, (left ? -85.0 : 85.0) * kDegree));
    std::copy(down.begin(), down.end(), q.begin() + tree.q_at(*shoulder));
  }
  return q;
}

}  // namespace posed
