#include "server/daemon/solving.h"

#include <algorithm>
#include <limits>

namespace posed {
namespace {

// The paper's solver takes hold of points and pulls them to places of the world.
bool reach_tree_takes(const SceneGoal& goal) {
  return std::holds_alternative<PositionTarget>(goal.goal.payload) &&
         goal.goal.relative_to.kind == GoalBase::Kind::world;
}

// What it makes of them all.
void note_goals(SolvedFigure& figure) {
  const auto& goals = figure.sources;
  if (std::any_of(goals.begin(), goals.end(), [](const SceneGoal* goal) { return !reach_tree_takes(*goal); }))
    figure.notes.push_back("only position goals relative to the world pull; the others are off");
  if (std::any_of(goals.begin(), goals.end(), [](const SceneGoal* goal) { return goal->goal.priority != 0; }))
    figure.notes.push_back("priorities count as equal");
}

// A target that is no point turns its goal off.
constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void Solving::gather(const Scene& scene) {
  std::erase_if(figures_, [&](const auto& entry) { return !scene.figures().contains(entry.first); });
  for (const auto& [id, figure] : scene.figures()) {
    SolvedFigure& solved = figures_[id];
    if (!solved.solver || &solved.solver->tree() != figure.tree.get()) {
      solved.solver = std::make_unique<ReachTreeSolver>(figure.tree);
    }
    solved.sources.clear();
    solved.goals.clear();
    solved.notes = {"joints count as balls and keep no limits"};
    if (!figure.entry.pins.empty()) solved.notes.push_back("pins are not kept");
  }
  for (const auto& [id, goal] : scene.goals()) {
    SolvedFigure& solved = figures_.at(goal.goal.figure);
    solved.sources.push_back(&goal);
    solved.goals.push_back({goal.at.segment, goal.at.point, goal.target(), goal.goal.weight.value, goal.goal.tolerance,
                            goal.goal.enabled});
  }
  for (auto& [id, solved] : figures_) note_goals(solved);
}

void Solving::solve(Scene& scene, bool live_only, const Clock& clock) {
  const bool edited = revision_ != scene.revision();
  if (edited) gather(scene);
  revision_ = scene.revision();
  for (auto& [id, figure] : figures_) {
    bool live = false;
    for (std::size_t i = 0; i < figure.sources.size(); ++i) {
      const SceneGoal& goal = *figure.sources[i];
      live = live || goal.follows_sensors();
      figure.goals[i].target = reach_tree_takes(goal) ? goal.target() : Vec3(kNowhere);
    }
    if (live_only && !edited && !live) continue;
    const std::vector<double>& present = scene.figures().at(id).q;
    figure.q.assign(present.begin(), present.end());
    const Nanoseconds begin = clock.now();
    const Nanoseconds end = begin + deadline_ns;
    figure.solver->solve(
        figure.q, figure.goals, options, [&clock, end] { return clock.now() > end; }, figure.pose);
    figure.solve_ns = clock.now() - begin;
    last_solve_ns_ = figure.solve_ns;
    ++solves_;
    scene.settle(id, figure.q);
  }
}

proto::FigurePose Solving::message(const std::string& id) const {
  const SolvedFigure& figure = figures_.at(id);
  proto::FigurePose message;
  message.figure = id;
  message.world_from_segment = figure.pose.world_from_segment;
  message.q = figure.pose.q;
  message.cost = figure.pose.report.cost;
  message.status = figure.pose.report.status;
  message.branch_changed = figure.pose.report.branch_changed;
  message.goals.reserve(figure.pose.goals.size());
  for (std::size_t i = 0; i < figure.pose.goals.size(); ++i) {
    const GoalReport& report = figure.pose.goals[i];
    proto::GoalFrame& goal = message.goals.emplace_back();
    goal.id = figure.sources[i]->goal.id;
    goal.touch = report.touch;
    goal.target = report.target;
    goal.error = report.error;
    goal.force = report.force;
    goal.state = report.state;
    for (const Cause& cause : report.causes) {
      if (cause.kind == Cause::Kind::goal) {
        goal.causes.push_back({figure.sources[static_cast<std::size_t>(cause.goal)]->goal.id, 0.0, "", {}});
      } else if (cause.kind == Cause::Kind::limit) {
        goal.causes.push_back({"", 0.0, figure.solver->tree().joint(cause.joint).name, cause.side});
      } else {
        goal.causes.push_back({"", cause.beyond_m, "", {}});
      }
    }
  }
  return message;
}

}  // namespace posed
