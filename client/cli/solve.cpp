#include "client/cli/output.h"

namespace posed::cli {
namespace {

constexpr auto kPatience = std::chrono::minutes(30);  // a batch may be long; Ctrl-C ends it

void show(const proto::SolveResult& result) {
  print_line(format("%s by %s in %.1f us, %d iterations  cost %g", std::string(proto::name_of(result.status)).c_str(),
                    result.method.c_str(), result.solve_us, result.iterations, result.cost));
  if (result.goals) {
    for (const proto::GoalFrame& goal : *result.goals) print_goal(goal);
  }
  for (const std::string& note : result.notes) print_line("  note: " + note);
}

void show(const proto::SolveBatchResult& answer) {
  for (std::size_t i = 0; i < answer.results.size(); ++i) {
    const proto::Solved& solved = answer.results[i];
    const std::string number = std::to_string(i) + "  ";
    if (solved.error) {
      print_line(number + "refused: " + solved.error->message + " (at " + solved.error->path + ")");
      continue;
    }
    std::size_t reached = 0, goals = 0;
    if (solved.result.goals) {
      goals = solved.result.goals->size();
      for (const proto::GoalFrame& goal : *solved.result.goals) reached += goal.state == GoalState::reached;
    }
    print_line(number + format("%s in %.1f us  %zu of %zu goals reached  cost %g",
                               std::string(proto::name_of(solved.result.status)).c_str(), solved.result.solve_us,
                               reached, goals, solved.result.cost));
  }
}

}  // namespace

int run_solve(const Session& session, const std::string& file, bool batch) {
  const Result<std::string> problem = read_file(file);
  if (!problem) return fail(problem.error());
  session.client.set_timeout(kPatience);
  session.client.on_progress([](std::uint64_t done, std::uint64_t of) {
    std::fprintf(stderr, "posectl: %llu of %llu\n", static_cast<unsigned long long>(done),
                 static_cast<unsigned long long>(of));
  });
  if (!batch) {
    return call<proto::SolveResult>(session, "solve", *problem, [](const proto::SolveResult& r) { show(r); });
  }
  return call<proto::SolveBatchResult>(session, "solve.batch", *problem,
                                       [](const proto::SolveBatchResult& r) { show(r); });
}

}  // namespace posed::cli
