#include "server/daemon/solving.h"

#include <algorithm>

#include "server/scene/spring_goals.h"

namespace posed {
namespace {

// Streams go on from frame to frame: a pose is right to half a tenth of a millimetre, and no joint turns faster than
// this, rad a solve.
constexpr double kLiveAccuracy = 5e-5;
constexpr double kLiveTurn = 0.25;
constexpr double kStillMoves = 0.05;  // of a value of q: well below what kLiveTurn allows

// Figures that goals tie together have the same number.
std::map<std::string, std::size_t> tie(const Scene& scene, Method method) {
  std::map<std::string, std::size_t> group;
  std::size_t next = 0;
  for (const auto& [id, figure] : scene.figures()) group[id] = next++;
  if (method == Method::reach_tree) return group;
  for (const auto& [id, goal] : scene.goals()) {
    if (!joins_figures(goal)) continue;
    const std::size_t a = group.at(goal.goal.figure), b = group.at(goal.goal.relative_to.figure);
    for (auto& [figure, number] : group) {
      if (number == b) number = a;
    }
  }
  return group;
}

}  // namespace

// A solver is kept where its figures are the same: it need not lay out the same goals again.
std::unique_ptr<FigureGroup> Solving::make_group(const std::vector<const SceneFigure*>& figures) {
  std::vector<std::shared_ptr<const BodyTree>> trees;
  trees.reserve(figures.size());
  for (const SceneFigure* figure : figures) trees.push_back(figure->tree);
  for (auto& group : groups_) {
    if (group && group->method() == method && group->trees() == trees) return std::move(group);
  }
  return std::make_unique<FigureGroup>(method, std::move(trees));
}

void Solving::gather(const Scene& scene) {
  const std::map<std::string, std::size_t> tied = tie(scene, method);
  struct Part {
    std::vector<const SceneFigure*> figures;
    std::vector<const SceneGoal*> goals;
    std::vector<const SceneBinding*> joints;
  };
  std::map<std::size_t, Part> parts;
  for (const auto& [id, figure] : scene.figures()) parts[tied.at(id)].figures.push_back(&figure);
  for (const auto& [id, goal] : scene.goals()) parts[tied.at(goal.goal.figure)].goals.push_back(&goal);
  for (const auto& [id, binding] : scene.bindings()) {
    if (!binding.binding.to.joint.empty()) parts[tied.at(binding.binding.to.figure)].joints.push_back(&binding);
  }
  std::vector<std::unique_ptr<FigureGroup>> groups;
  figures_.clear();
  for (auto& [number, part] : parts) {
    FigureGroup& group = *groups.emplace_back(make_group(part.figures));
    group.set(std::move(part.figures), std::move(part.goals), std::move(part.joints));
    for (std::size_t i = 0; i < group.ids().size(); ++i) figures_[group.ids()[i]] = {&group, i, 0};
  }
  groups_ = std::move(groups);
  gathered_ = method;
}

SolverOptions Solving::options(bool live_only, bool explore) const {
  SolverOptions options;
  options.reach_tree.root_iterations = options.springs.iterations = iterations;
  options.reach_tree.branch_iterations = branch_iterations;
  options.springs.explore = explore && !live_only;
  if (live_only) {
    options.springs.accuracy = kLiveAccuracy;
    options.springs.most_turn = kLiveTurn;
  }
  return options;
}

bool Solving::solve(Scene& scene, bool live_only, const Clock& clock, bool explore) {
  const bool edited = revision_ != scene.revision() || gathered_ != method;
  if (edited) gather(scene);
  revision_ = scene.revision();
  const SolverOptions how = options(live_only && !edited, explore);
  bool way_to_go = false;
  for (const auto& group : groups_) {
    if (live_only && !edited && !group->live()) continue;
    const Nanoseconds begin = clock.now();
    const Nanoseconds end = begin + deadline_ns;
    group->solve(how, [&clock, end] { return clock.now() > end; });
    last_solve_ns_ = clock.now() - begin;
    ++solves_;
    way_to_go = way_to_go || (live_only && group->moved() > kStillMoves);
    for (std::size_t i = 0; i < group->ids().size(); ++i) {
      scene.settle(group->ids()[i], group->q(i));
      figures_.find(group->ids()[i])->second.solve_ns = last_solve_ns_;
    }
  }
  return way_to_go;
}

const Transform* Solving::world_from_segment(const std::string& figure, int segment) const {
  const auto solved = figures_.find(figure);
  if (solved == figures_.end()) return nullptr;
  const std::vector<Transform>& world = solved->second.group->world_from_segment(solved->second.index);
  return static_cast<std::size_t>(segment) < world.size() ? &world[static_cast<std::size_t>(segment)] : nullptr;
}

proto::FigurePose Solving::message(const std::string& id) const {
  const Solved& solved = figures_.at(id);
  return solved.group->message(solved.index);
}

}  // namespace posed
