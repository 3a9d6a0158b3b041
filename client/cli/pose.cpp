#include "client/cli/output.h"

namespace posed::cli {
namespace {

std::string because(const proto::GoalFrame::Because& cause) {
  const std::string whose = cause.figure.empty() ? "" : " of " + cause.figure;
  if (!cause.goal.empty()) return "held by " + cause.goal;
  if (!cause.pin.empty()) return "held by the pin of " + cause.pin + whose;
  if (!cause.limit.empty()) return "at a limit of " + cause.limit + whose;
  return format("%.1f mm beyond reach", cause.beyond_m * 1e3);
}

void show(const proto::PoseResult& result) {
  const proto::FigurePose& pose = result.pose;
  print_line(format("%s  t %.3f s  revision %llu  %s by %s in %.1f us, %d passes  cost %g", pose.figure.c_str(),
                    static_cast<double>(result.t_ns) * 1e-9, static_cast<unsigned long long>(result.revision),
                    std::string(proto::name_of(pose.status)).c_str(), result.method.c_str(), result.solve_us,
                    result.iterations, pose.cost));
  for (const proto::GoalFrame& goal : pose.goals) {
    std::string line = format("  %s  %s  error %.1f mm  touch [%.4f %.4f %.4f]", goal.id.c_str(),
                              std::string(proto::name_of(goal.state)).c_str(), goal.error * 1e3, goal.touch.x,
                              goal.touch.y, goal.touch.z);
    for (const auto& cause : goal.causes) line += "  " + because(cause);
    print_line(line);
  }
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
