// Stateless solves: they touch nothing of the scene, and the workers do them.
#include <algorithm>

#include "common/names.h"
#include "server/daemon/requests.h"
#include "server/daemon/solve_job.h"

namespace posed {
namespace {

using Figures = std::map<std::string, std::shared_ptr<ProblemFigure>>;

// What a problem is to stand on. Those of the scene are copied once.
Result<std::shared_ptr<ProblemFigure>> figure_of(const Scene& scene, const std::optional<proto::FigureChoice>& choice,
                                                 Figures& of_scene) {
  if (choice && (choice->document || !choice->template_name.empty())) return std::make_shared<ProblemFigure>(*choice);
  const Result<const SceneFigure*> found = scene.find_figure(choice ? choice->id : "");
  if (!found) return found.error();
  auto& figure = of_scene[(*found)->entry.id];
  if (!figure) figure = std::make_shared<ProblemFigure>(**found);
  return figure;
}

}  // namespace

void Requests::on(proto::Solve& m, Responder responder) {
  proto::SolveBatch batch;
  batch.problems.push_back({std::move(static_cast<proto::Problem&>(m)), {}, ""});
  batch.fields = std::move(m.fields);
  start_solving(std::move(batch), true, std::move(responder));
}

void Requests::on(proto::SolveBatch& m, Responder responder) {
  start_solving(std::move(m), false, std::move(responder));
}

void Requests::start_solving(proto::SolveBatch batch, bool alone, Responder responder) {
  if (!responder.wanted()) return responder.deliver("");  // a notification: nobody would see the answer
  SolveJob::Work work;
  work.alone = alone;
  if (const Status checked = Publisher::check_fields(batch.fields); !checked)
    return responder.params_error(checked.error());
  work.fields = Publisher::fields_of(batch.fields);
  Figures of_scene;
  std::shared_ptr<ProblemFigure> common;  // of problems that name none
  for (std::size_t i = 0; i < batch.problems.size(); ++i) {
    proto::ProblemEntry& entry = batch.problems[i];
    auto& figure = work.figures.emplace_back();
    if (entry.error) continue;
    if (!entry.problem.figure && common) {
      figure = common;
      continue;
    }
    const auto found = figure_of(p_.scene, entry.problem.figure ? entry.problem.figure : batch.figure, of_scene);
    if (!found && (alone || !entry.problem.figure)) return responder.params_error(found.error());
    if (!found) {
      entry.error = found.error();
      entry.error->path = "/params/problems/" + std::to_string(i) + entry.error->path;
      continue;
    }
    figure = *found;
    if (!entry.problem.figure) common = figure;
  }
  if (batch.problems.empty()) return responder.result(proto::SolveBatchResult{});
  if (!p_.sessions.contains(connection_)) return;  // it is gone, and nobody would drop the work
  work.batch = std::move(batch);
  auto job = std::make_shared<SolveJob>(
      connection_, SolveJob::Station{p_.loop, p_.server, p_.clock, p_.problem_solvers, p_.solving.method},
      std::move(work), responder);
  if (!p_.workers.add(std::move(job))) {
    responder.error(
        {"busy", "too many problems wait to be solved", "", "try again in a moment, or send fewer at once"});
  }
}

}  // namespace posed
