#include "client/cli/output.h"

namespace posed::cli {
namespace {

std::string show(const Attachment& at) {
  if (at.segment.empty()) return at.site;
  if (!at.site.empty()) return at.segment + '/' + at.site;
  if (!at.point) return at.segment;
  return at.segment + format(" [%g %g %g]", at.point->x, at.point->y, at.point->z);
}

}  // namespace

int list_goals(const Session& session) {
  return request<proto::GoalListResult>(session, proto::GoalList{}, [](const proto::GoalListResult& list) {
    if (list.goals.empty()) print_line("no goals");
    for (const proto::GoalResult& entry : list.goals) {
      const Goal& goal = entry.goal;
      std::string line = format("%s  %s at %s  [%g %g %g] m  weight %g", goal.id.c_str(), goal.figure.c_str(),
                                show(goal.at).c_str(), goal.position.x, goal.position.y, goal.position.z, goal.weight);
      if (goal.tolerance > 0.0) line += format("  tolerance %g m", goal.tolerance);
      if (!goal.enabled) line += "  disabled";
      if (!goal.label.empty()) line += "  " + goal.label;
      print_line(line);
    }
  });
}

int set_goal(const Session& session, const proto::GoalSet& goal) {
  return request<proto::EditResult>(session, goal, [](const proto::EditResult& result) {
    print_line(
        format("%s is set (revision %llu)", result.id.c_str(), static_cast<unsigned long long>(result.revision)));
  });
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
