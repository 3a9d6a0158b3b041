// Figures, joints, objects and bindings.
#include "client/cli/output.h"

namespace posed::cli {
namespace {

void show_set(const proto::EditResult& result) {
  print_line(format("%s is set (revision %llu)", result.id.c_str(), static_cast<unsigned long long>(result.revision)));
}

std::string show(const Vec3& v) {
  return format("[%g %g %g]", v.x, v.y, v.z);
}

std::string show(const Quat& q) {
  const std::array<double, 4> v = xyzw(q);
  return format("[%g %g %g %g]", v[0], v[1], v[2], v[3]);
}

void print_object(const proto::ObjectResult& entry) {
  const Object& object = entry.object;
  std::string line = object.id + "  " + show(object.world_from_object.position) + " m  " +
                     show(object.world_from_object.rotation) + format("  %zu shapes", object.shapes.size());
  if (!object.label.empty()) line += "  " + object.label;
  print_line(line);
}

void print_figure(const proto::FigureResult& figure) {
  const FigureEntry& entry = figure.entry;
  print_line(entry.id + "  " +
             (entry.template_name.empty() ? "a figure of its own"
                                          : entry.template_name + format(", stature %g m", entry.stature)) +
             format("  %zu segments", figure.document.segments.size()));
  for (const Segment& segment : figure.document.segments) {
    std::string line = "  " + segment.name + "  by " + segment.joint.name;
    if (!segment.parent.empty()) line += " to " + segment.parent;
    if (entry.pins.contains(segment.name)) line += "  pinned";
    print_line(line);
  }
}

void print_joint(const proto::JointResult& joint, bool degrees) {
  const double unit = degrees ? 180.0 / 3.14159265358979323846 : 1.0;
  std::string line = joint.figure + ' ' + joint.joint + "  value";
  for (const double value : joint.value) line += format(" %.7g", joint.type == JointType::hinge ? unit * value : value);
  const char* name = degrees ? "degrees" : "rad";
  if (joint.halfplane && joint.deviation && joint.twist)
    line += format("  halfplane %.4g, deviation %.4g, twist %.4g %s", unit * *joint.halfplane, unit * *joint.deviation,
                   unit * *joint.twist, name);
  print_line(line);
}

// Lists each entry with `show`, or says that there is none.
template <class R, class Entry>
int list(const Session& session, const proto::Params& params, std::vector<Entry> R::*entries, const char* none,
         void (*print)(const Entry&)) {
  return request<R>(session, params, [&](const R& result) {
    if ((result.*entries).empty()) print_line(none);
    for (const Entry& entry : result.*entries) print(entry);
  });
}

void print_summary(const proto::FigureSummary& figure) {
  print_line(figure.id + "  " +
             (figure.template_name.empty() ? "a figure of its own"
                                           : figure.template_name + format(", stature %g m", figure.stature)) +
             format("  %d segments", figure.segments));
}

}  // namespace

int set_entity(const Session& session, const proto::Params& params) {
  return request<proto::EditResult>(session, params, show_set);
}

int set_entity(const Session& session, const std::string& method, const std::string& params) {
  return call<proto::EditResult>(session, method, params, show_set);
}

int list_figures(const Session& session) {
  return list<proto::FigureListResult>(session, proto::FigureList{}, &proto::FigureListResult::figures, "no figures",
                                       print_summary);
}

int get_figure(const Session& session, const std::string& id) {
  return request<proto::FigureResult>(session, proto::FigureGet{id}, print_figure);
}

int remove_figure(const Session& session, const std::string& id) {
  return edit(session, proto::FigureRemove{id}, id + " is removed");
}

int set_figure(const Session& session, const proto::FigureSet& figure, const std::string& file) {
  proto::FigureSet whole = figure;
  if (!file.empty()) {
    const auto text = read_file(file);
    if (!text) return fail(text.error());
    auto document = proto::decode_figure(*text);
    if (!document) return fail(document.error());
    whole.document = std::move(*document);
  }
  return set_entity(session, whole);
}

int pin_segment(const Session& session, const std::string& figure, const std::string& segment,
                const std::string& hold) {
  proto::FigurePin pin{figure, segment, {}};
  if (hold == "position") pin.hold = Pin::Hold::position;
  if (hold == "orientation") pin.hold = Pin::Hold::orientation;
  if (hold == "pose") pin.hold = Pin::Hold::pose;
  return edit(session, pin, segment + (pin.hold ? " is pinned" : " is free"));
}

int get_joint(const Session& session, const std::string& figure, const std::string& joint, bool degrees) {
  return request<proto::JointResult>(session, proto::JointGet{figure, joint},
                                     [degrees](const proto::JointResult& r) { print_joint(r, degrees); });
}

int set_joint(const Session& session, const proto::JointSet& joint) {
  return edit(session, joint, joint.joint + " is turned");
}

int list_objects(const Session& session) {
  return list<proto::ObjectListResult>(session, proto::ObjectList{}, &proto::ObjectListResult::objects, "no objects",
                                       print_object);
}

int get_object(const Session& session, const std::string& id) {
  return request<proto::ObjectResult>(session, proto::ObjectGet{id}, print_object);
}

int remove_object(const Session& session, const std::string& id) {
  return edit(session, proto::ObjectRemove{id}, id + " is removed");
}

}  // namespace posed::cli
