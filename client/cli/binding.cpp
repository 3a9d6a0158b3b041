#include <algorithm>

#include "client/cli/output.h"

namespace posed::cli {
namespace {

std::string show(const BindingTarget& to) {
  if (!to.goal.empty()) return "goal " + to.goal;
  if (!to.object.empty()) return "object " + to.object;
  if (!to.camera.empty()) return "camera " + to.camera;
  return "joint " + to.joint + " of " + to.figure;
}

std::string show(const Axes& axes) {
  std::string text;
  for (const auto& [on, name] : {std::pair{axes.x, " x"},
                                 {axes.y, " y"},
                                 {axes.z, " z"},
                                 {axes.rx, " rx"},
                                 {axes.ry, " ry"},
                                 {axes.rz, " rz"}}) {
    if (on) text += name;
  }
  return text;
}

void print_binding(const proto::BindingResult& entry) {
  const Binding& b = entry.binding;
  std::string line = b.id + "  " + b.sensor + " moves " + show(b.to);
  if (b.axes) line += show(*b.axes);
  if (b.mode == Binding::Mode::relative) line += "  relative";
  if (b.clutch) line += format("  while button %d is held", b.clutch->button);
  for (const ButtonAction& action : b.buttons)
    line += format("  button %d: %s", action.button, kButtonActionNames[static_cast<std::size_t>(action.act)]);
  if (b.scale != 1.0) line += format("  scale %g", b.scale);
  if (b.filter && b.filter->one_euro)
    line += format("  one-euro %g Hz, beta %g", b.filter->one_euro->min_cutoff_hz, b.filter->one_euro->beta);
  if (b.filter && b.filter->predict_ms > 0.0) line += format("  %g ms ahead", b.filter->predict_ms);
  if (!b.label.empty()) line += "  " + b.label;
  print_line(line);
}

}  // namespace

int list_bindings(const Session& session) {
  return request<proto::BindingListResult>(session, proto::BindingList{}, [](const proto::BindingListResult& list) {
    if (list.bindings.empty()) print_line("no bindings");
    for (const proto::BindingResult& entry : list.bindings) print_binding(entry);
  });
}

int get_binding(const Session& session, const std::string& id) {
  return request<proto::BindingResult>(session, proto::BindingGet{id}, print_binding);
}

int remove_binding(const Session& session, const std::string& id) {
  return edit(session, proto::BindingRemove{id}, id + " is removed");
}

int bind_sensor(const Session& session, const proto::BindingSet& binding) {
  return request<proto::EditResult>(session, binding, print_set);
}

int unbind_sensor(const Session& session, std::string id) {
  std::replace(id.begin(), id.end(), ':', '.');  // a sensor's own binding has that name
  return edit(session, proto::BindingRemove{id}, id + " is removed; what it moved stays where it is");
}

}  // namespace posed::cli
