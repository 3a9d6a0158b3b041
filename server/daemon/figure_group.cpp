#include "server/daemon/figure_group.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/names.h"
#include "server/scene/spring_goals.h"

namespace posed {
namespace {

constexpr const char* kMethodNames[] = {"springs", "reach_tree"};

// The paper's solver takes hold of points and pulls them to places of the world.
bool reach_tree_takes(const SceneGoal& goal) {
  return std::holds_alternative<PositionTarget>(goal.goal.payload) &&
         goal.goal.relative_to.kind == GoalBase::Kind::world;
}

// A target that is no point turns its goal off.
constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

}  // namespace

const char* name_of(Method method) {
  return kMethodNames[static_cast<std::size_t>(method)];
}

Result<Method> find_method(const std::string& name) {
  for (const Method method : {Method::springs, Method::reach_tree}) {
    if (name == name_of(method)) return method;
  }
  return Error{"invalid_params", "no method is called " + name.substr(0, 64), "/method", "springs or reach_tree"};
}

FigureGroup::FigureGroup(Method method, std::vector<std::shared_ptr<const BodyTree>> trees)
    : method_(method), trees_(std::move(trees)) {
  if (method == Method::springs)
    spring_solver_ = std::make_unique<SpringSolver>(trees_);
  else
    reach_solver_ = std::make_unique<ReachTreeSolver>(trees_.at(0));
  pose_.q.resize(trees_.size());
  before_.resize(trees_.size());
}

std::size_t FigureGroup::index_of(const std::string& figure) const {
  return static_cast<std::size_t>(std::find(ids_.begin(), ids_.end(), figure) - ids_.begin());
}

void FigureGroup::set(std::vector<const SceneFigure*> figures, std::vector<const SceneGoal*> goals,
                      std::vector<const SceneBinding*> joints) {
  figures_ = std::move(figures);
  goals_ = std::move(goals);
  joints_ = std::move(joints);
  ids_.clear();
  for (const SceneFigure* figure : figures_) ids_.push_back(figure->entry.id);
  pullers_.clear();
  for (const SceneGoal* goal : goals_)
    pullers_.push_back({goal->goal.id, index_of(goal->goal.figure), Puller::Kind::goal});
  method_ == Method::springs ? set_springs() : set_reach_tree();
}

void FigureGroup::set_springs() {
  springs_.clear();
  for (const SceneGoal* goal : goals_) {
    SpringGoal& spring = springs_.emplace_back(spring_goal(*goal));
    spring.figure = spring.base_figure = static_cast<int>(index_of(goal->goal.figure));
    if (!joins_figures(*goal)) continue;
    spring.base_figure = static_cast<int>(index_of(goal->goal.relative_to.figure));
    spring.base_segment = goal->base_segment;
  }
  for (std::size_t f = 0; f < figures_.size(); ++f) {
    std::vector<SpringGoal> pins = pin_goals(*figures_[f]);
    auto segment = figures_[f]->entry.pins.begin();
    for (SpringGoal& pin : pins) {
      pin.figure = pin.base_figure = static_cast<int>(f);
      springs_.push_back(std::move(pin));
      pullers_.push_back({(segment++)->first, f, Puller::Kind::pin});
    }
  }
  for (const SceneBinding* binding : joints_) {
    const std::size_t f = index_of(binding->binding.to.figure);
    SpringGoal& spring = springs_.emplace_back(joint_spring(*binding, *trees_[f]));
    spring.figure = spring.base_figure = static_cast<int>(f);
    pullers_.push_back({binding->binding.id, f, Puller::Kind::binding});
  }
}

void FigureGroup::set_reach_tree() {
  reaches_.clear();
  reach_notes_ = {"joints count as balls and keep no limits"};
  for (const SceneGoal* goal : goals_) {
    reaches_.push_back({goal->at.segment, goal->at.point, goal->target(), goal->goal.weight.value, goal->goal.tolerance,
                        goal->goal.enabled});
  }
  if (!joints_.empty()) reach_notes_.push_back("joints follow no sensors");
  if (!figures_[0]->entry.pins.empty()) reach_notes_.push_back("pins are not kept");
  if (std::any_of(goals_.begin(), goals_.end(), [](const SceneGoal* goal) { return !reach_tree_takes(*goal); }))
    reach_notes_.push_back("only position goals relative to the world pull; the others are off");
  if (std::any_of(goals_.begin(), goals_.end(), [](const SceneGoal* goal) { return goal->goal.priority != 0; }))
    reach_notes_.push_back("priorities count as equal");
}

bool FigureGroup::live() const {
  return std::any_of(goals_.begin(), goals_.end(), [](const SceneGoal* goal) { return goal->follows_sensors(); }) ||
         std::any_of(joints_.begin(), joints_.end(), [](const SceneBinding* joint) { return joint->moves_joint; });
}

void FigureGroup::solve(const SolverOptions& options, const std::function<bool()>& should_stop) {
  for (std::size_t f = 0; f < figures_.size(); ++f) {
    pose_.q[f].assign(figures_[f]->q.begin(), figures_[f]->q.end());
    before_[f].assign(figures_[f]->q.begin(), figures_[f]->q.end());
  }
  if (method_ == Method::springs) {
    for (std::size_t g = 0; g < goals_.size(); ++g) follow_sensors(*goals_[g], springs_[g]);
    const std::size_t first = springs_.size() - joints_.size();
    for (std::size_t j = 0; j < joints_.size(); ++j) follow_sensor(*joints_[j], springs_[first + j]);
    spring_solver_->solve(springs_, options.springs, should_stop, pose_);
    return;
  }
  for (std::size_t g = 0; g < goals_.size(); ++g)
    reaches_[g].target = reach_tree_takes(*goals_[g]) ? goals_[g]->target() : Vec3(kNowhere);
  reach_solver_->solve(pose_.q[0], reaches_, options.reach_tree, should_stop, reach_pose_);
  pose_.world_from_segment.resize(1);
  pose_.world_from_segment[0].swap(reach_pose_.world_from_segment);
  pose_.goals.swap(reach_pose_.goals);
  pose_.report = reach_pose_.report;
}

double FigureGroup::moved() const {
  double most = 0.0;
  for (std::size_t f = 0; f < before_.size(); ++f) {
    const std::size_t first = trees_[f]->joint(0).type == JointType::free ? 7 : 0;
    for (std::size_t i = first; i < before_[f].size(); ++i)
      most = std::max(most, std::abs(pose_.q[f][i] - before_[f][i]));
  }
  return most;
}

proto::GoalFrame::Because FigureGroup::because(const Cause& cause, std::size_t figure) const {
  proto::GoalFrame::Because because;
  const auto say_figure = [&](std::size_t whose) {
    if (whose != figure) because.figure = ids_[whose];
  };
  if (cause.kind == Cause::Kind::beyond) {
    because.beyond_m = cause.beyond_m;
  } else if (cause.kind == Cause::Kind::limit) {
    const auto whose = static_cast<std::size_t>(cause.figure);
    because.limit = trees_[whose]->joint(cause.joint).name;
    because.side = cause.side;
    say_figure(whose);
  } else if (const Puller& puller = pullers_[static_cast<std::size_t>(cause.goal)]; puller.kind != Puller::Kind::goal) {
    (puller.kind == Puller::Kind::pin ? because.pin : because.binding) = puller.id;
    say_figure(puller.figure);
  } else {
    because.goal = puller.id;
  }
  return because;
}

proto::FigurePose FigureGroup::message(std::size_t figure) const {
  proto::FigurePose message;
  message.figure = ids_[figure];
  message.world_from_segment = pose_.world_from_segment[figure];
  message.q = pose_.q[figure];
  message.cost = pose_.report.cost;
  message.status = pose_.report.status;
  message.branch_changed = pose_.report.branch_changed;
  message.goals.reserve(pose_.goals.size());
  for (std::size_t i = 0; i < pose_.goals.size(); ++i) {
    if (pullers_[i].kind != Puller::Kind::goal || pullers_[i].figure != figure) continue;
    const GoalReport& report = pose_.goals[i];
    proto::GoalFrame& goal = message.goals.emplace_back();
    goal.id = pullers_[i].id;
    goal.touch = report.touch;
    goal.target = report.target;
    goal.error = report.error;
    goal.force = report.force;
    goal.state = report.state;
    for (const Cause& cause : report.causes) goal.causes.push_back(because(cause, figure));
  }
  return message;
}

std::vector<std::string> FigureGroup::notes() const {
  if (method_ == Method::reach_tree) return reach_notes_;
  std::size_t pulling = 0, reached = 0;
  for (std::size_t i = 0; i < pose_.goals.size(); ++i) {
    if (pullers_[i].kind != Puller::Kind::goal || pose_.goals[i].state == GoalState::off) continue;
    ++pulling;
    reached += pose_.goals[i].state == GoalState::reached;
  }
  std::vector<std::string> notes;
  if (pulling > 1 && reached == pulling) notes.push_back("all goals are reached: their weights do not matter");
  if (ids_.size() > 1) {
    std::string tied = "goals tie these figures together, and they are solved as one:";
    for (const std::string& id : ids_) tied += " " + id;
    notes.push_back(std::move(tied));
  }
  return notes;
}

}  // namespace posed
