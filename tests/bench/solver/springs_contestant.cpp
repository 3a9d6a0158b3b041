#include "server/solver/springs/spring_solver.h"
#include "tests/bench/solver/contestant.h"
#include "tests/bench/solver/race.h"

namespace posed::test {
namespace {

// posed's own. A problem of the sets a to d is a stateless one: cold, from several starts. A frame of a stream starts
// from the last one's answer.
class Springs final : public Contestant {
 public:
  explicit Springs(const HingeFigure& figure)
      : figure_(figure), solver_(std::make_shared<const BodyTree>(figure.tree())) {}

  std::string who() const override { return kOurs; }

  void prepare(const Problem& problem, std::span<const double> start, bool stream) override {
    goals_.resize(problem.size());
    for (std::size_t i = 0; i < problem.size(); ++i) {
      goals_[i].at = problem[i].at;
      goals_[i].spring = PositionSpring{problem[i].target};
      goals_[i].weight = problem[i].weight;
    }
    options_.cold = !stream;
    options_.accuracy = kAskedRms;
    options_.explain = false;
    pose_.q = {figure_.tree_q(start)};
    solver_.prepare(goals_);
  }
  void solve() override { solver_.solve(goals_, options_, {}, pose_); }
  void answer(std::span<double> x) const override {
    const std::vector<double> found = figure_.from_tree_q(pose_.q[0]);
    std::copy(found.begin(), found.end(), x.begin());
  }

 private:
  const HingeFigure& figure_;
  SpringSolver solver_;
  std::vector<SpringGoal> goals_;
  SpringOptions options_;
  SpringPose pose_;
};

}  // namespace

std::unique_ptr<Contestant> springs_contestant(const HingeFigure& figure) {
  return std::make_unique<Springs>(figure);
}

}  // namespace posed::test
