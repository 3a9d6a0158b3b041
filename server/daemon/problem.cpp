#include "server/daemon/problem.h"

#include "server/scene/errors.h"

namespace posed {
namespace {

constexpr const char* kOwnFigure = "body";

template <class T>
const std::optional<T>& either(const std::optional<T>& own, const std::optional<T>& common) {
  return own ? own : common;
}

Result<SceneFigure> make(const proto::FigureChoice& choice) {
  SceneDocument document;
  FigureEntry& entry = document.figures[kOwnFigure];
  entry.template_name = choice.template_name;
  entry.stature = choice.stature;
  entry.document = choice.document;
  Scene scene;
  if (const Status loaded = scene.load(document); !loaded) {
    Error error = loaded.error();
    for (const std::string& prefix : {std::string("/figures/") + kOwnFigure, std::string("/document")}) {
      if (error.path.starts_with(prefix)) error.path.erase(0, prefix.size());
    }
    return below("/figure", std::move(error));
  }
  SceneFigure figure = scene.figures().at(kOwnFigure);
  figure.entry.document.reset();  // the tree has it
  return figure;
}

// The figure as the problem has it stand and pinned.
Result<Scene> place(const ProblemTask& task) {
  const Result<SceneFigure>& given = task.figure.get();
  if (!given) return given.error();
  const auto& start = either(task.problem.start, task.common.start);
  const auto& pins = either(task.problem.pins, task.common.pins);
  SceneFigure figure = *given;
  const std::string id = figure.entry.id;
  if (start && start->kind == proto::Start::Kind::current) {
    if (!task.figure.in_scene())
      return Error{"invalid_params", "only a figure of the scene has a current pose", "/start",
                   R"("rest", {"q":[…]}, or the figure's id)"};
  } else {
    figure.q = figure.tree->rest();
  }
  Scene scene(std::move(figure));
  if (start && start->kind == proto::Start::Kind::q) {
    if (const auto set = scene.set_q(id, start->q, {}); !set) return below("/start", set.error());
  }
  if (pins) {
    if (const auto set = scene.set_pins(id, *pins, {}); !set) return set.error();
  }
  return scene;
}

Result<std::string> add_goal(Scene& scene, const std::string& figure, GoalEdit edit, std::size_t index) {
  if (edit.id.empty()) edit.id = "g" + std::to_string(index + 1);
  if (scene.goals().contains(edit.id))
    return Error{"bad_id", "two goals are called " + edit.id.substr(0, 64), "/id", "leave the ids out"};
  const GoalBase* base = edit.relative_to.value();
  if (base && base->kind == GoalBase::Kind::sensor)
    return Error{"invalid_params", "a problem has no sensors", "/relative_to", "say where the sensor is"};
  if (base && base->kind == GoalBase::Kind::object)
    return Error{"invalid_params", "a problem has no objects", "/relative_to", "say where the object is"};
  if (base && base->kind == GoalBase::Kind::segment && !base->figure.empty() && base->figure != figure)
    return Error{"invalid_params", "a problem has one figure", "/relative_to/figure",
                 "say where the other figure's segment is"};
  if (!edit.figure.empty() && edit.figure != figure)
    return Error{"invalid_params", "a problem has one figure", "/figure", "leave it out"};
  const Result<Edited> set = scene.set_goal(edit, {});
  if (!set) return set.error();
  return set->id;
}

}  // namespace

ProblemFigure::ProblemFigure(const SceneFigure& present) : in_scene_(true), made_(present) {
  (*made_)->entry.document.reset();
}

ProblemFigure::ProblemFigure(const proto::FigureChoice& choice) : in_scene_(false), choice_(choice) {}

const Result<SceneFigure>& ProblemFigure::get() {
  std::call_once(once_, [this] {
    if (!made_) made_ = make(choice_);
  });
  return *made_;
}

Result<proto::SolveResult> ProblemSolver::solve(const ProblemTask& task, Method fallback, const Clock& clock,
                                                const std::atomic<bool>& dropped) {
  const auto& method_name = either(task.problem.method, task.common.method);
  const Result<Method> method = method_name ? find_method(*method_name) : fallback;
  if (!method) return method.error();
  Result<Scene> scene = place(task);
  if (!scene) return scene.error();
  const SceneFigure& figure = scene->figures().begin()->second;
  std::vector<const SceneGoal*> goals;
  for (std::size_t i = 0; i < task.problem.goals.size(); ++i) {
    const auto id = add_goal(*scene, figure.entry.id, task.problem.goals[i].edit, i);
    if (!id) return below("/goals/" + std::to_string(i), id.error());
    goals.push_back(&scene->goals().at(*id));
  }

  if (!group_ || group_->method() != *method || group_->trees()[0] != figure.tree)
    group_ = std::make_unique<FigureGroup>(*method, std::vector{figure.tree});
  group_->set({&figure}, std::move(goals));
  SolverOptions options;
  options.springs.cold = !either(task.problem.start, task.common.start);
  options.springs.explore = true;
  const auto& deadline_us = either(task.problem.deadline_us, task.common.deadline_us);
  const Nanoseconds begin = clock.now();
  const Nanoseconds end = begin + (deadline_us ? Nanoseconds{*deadline_us} * 1000 : kProblemDeadline);
  group_->solve(options, [&clock, &dropped, end] { return dropped || clock.now() > end; });

  proto::SolveResult result;
  result.solve_us = 1e-3 * static_cast<double>(clock.now() - begin);
  proto::FigurePose pose = group_->message(0);
  if (task.fields.q) result.q = std::move(pose.q);
  if (task.fields.world_from_segment) result.world_from_segment = std::move(pose.world_from_segment);
  if (task.fields.goals) result.goals = std::move(pose.goals);
  result.cost = pose.cost;
  result.status = pose.status;
  result.branch_changed = pose.branch_changed;
  result.iterations = group_->report().iterations;
  result.method = name_of(*method);
  result.notes = group_->notes();
  return result;
}

}  // namespace posed
