#include "client/cli/output.h"

namespace posed::cli {
namespace {

std::string show(const Attachment& at) {
  if (at.segment.empty()) return at.site;
  if (!at.site.empty()) return at.segment + '/' + at.site;
  if (!at.point) return at.segment;
  return at.segment + format(" [%g %g %g]", at.point->x, at.point->y, at.point->z);
}

void print_goal_entity(const proto::GoalResult& entry) {
  const Goal& goal = entry.goal;
  const GoalKind kind = kind_of(goal.payload);
  std::string line = goal.id + "  " + goal.figure;
  if (takes_hold(kind)) line += " at " + show(goal.at);
  if (kind != GoalKind::position) line += std::string("  ") + name_of(kind);
  if (const Vec3* p = position_of(goal.payload)) line += format("  [%g %g %g] m", p->x, p->y, p->z);
  line += show_base(goal.relative_to);
  line += format("  weight %g", goal.weight.value);
  if (goal.weight.orientation) line += format(" and %g", *goal.weight.orientation);
  if (goal.priority != 0) line += format("  priority %d", goal.priority);
  if (const auto& box = goal.tolerance.box)
    line += format("  tolerance [%g %g %g] m", box->x, box->y, box->z);
  else if (goal.tolerance.radius > 0.0)
    line += format("  tolerance %g m", goal.tolerance.radius);
  if (!goal.enabled) line += "  disabled";
  if (!entry.held_by.empty()) line += "  held by " + entry.held_by;
  if (!goal.label.empty()) line += "  " + goal.label;
  print_line(line);
}

}  // namespace

int list_goals(const Session& session) {
  return request<proto::GoalListResult>(session, proto::GoalList{}, [](const proto::GoalListResult& list) {
    if (list.goals.empty()) print_line("no goals");
    for (const proto::GoalResult& entry : list.goals) print_goal_entity(entry);
  });
}

int get_goal(const Session& session, const std::string& id) {
  return request<proto::GoalResult>(session, proto::GoalGet{id}, print_goal_entity);
}

int remove_goal(const Session& session, const std::string& id) {
  return edit(session, proto::GoalRemove{id}, id + " is removed");
}

int clear_goals(const Session& session, const std::string& figure) {
  return request<proto::ClearResult>(session, proto::GoalClear{figure}, [](const proto::ClearResult& result) {
    print_line(format("%d goals are removed (revision %llu)", result.removed,
                      static_cast<unsigned long long>(result.revision)));
  });
}

}  // namespace posed::cli
