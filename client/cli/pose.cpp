#include "client/cli/output.h"

namespace posed::cli {
namespace {

void show(const proto::PoseResult& result) {
  const proto::FigurePose& pose = result.pose;
  print_line(format("%s  t %.3f s  revision %llu  %s by %s in %.1f us, %d passes  cost %g", pose.figure.c_str(),
                    static_cast<double>(result.t_ns) * 1e-9, static_cast<unsigned long long>(result.revision),
                    std::string(proto::name_of(pose.status)).c_str(), result.method.c_str(), result.solve_us,
                    result.iterations, pose.cost));
  for (const proto::GoalFrame& goal : pose.goals) print_goal(goal);
  for (const std::string& note : result.notes) print_line("  note: " + note);
}

}  // namespace

int get_pose(const Session& session, const std::string& figure) {
  proto::PoseGet get;
  get.figure = figure;
  return request<proto::PoseResult>(session, get, show);
}

int reset_pose(const Session& session, const std::string& figure, const std::string& to) {
  return edit(session, proto::PoseReset{figure, to}, "the pose is reset to " + to);
}

int mirror_pose(const Session& session, const std::string& figure) {
  return edit(session, proto::PoseMirror{figure}, "the pose is mirrored");
}

}  // namespace posed::cli
