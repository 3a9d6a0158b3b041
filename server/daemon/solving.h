// Poses of all figures of the scene: keeps a solver for each, or for those together that goals tie together, and calls
// it where goals have moved. Station loop only.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/time.h"
#include "server/daemon/figure_group.h"

namespace posed {

class Solving {
 public:
  Method method = Method::springs;
  int iterations = SpringOptions{}.iterations;  // of each method: passes at the root, steps of a descent
  int branch_iterations = ReachTreeOptions{}.branch_iterations;
  Nanoseconds deadline_ns = 20'000'000;

  // Solves every figure from its present q, or those only that a live goal pulls at, and hands q back to the scene.
  // True where a bound on the joints' speed may have left live goals a way to go.
  // `explore`: other starts than the present pose may win after an edit.
  bool solve(Scene& scene, bool live_only, const Clock& clock, bool explore = true);

  struct Solved {
    const FigureGroup* group;
    std::size_t index;  // in the group
    Nanoseconds solve_ns;
  };
  const std::map<std::string, Solved>& figures() const { return figures_; }
  Revision revision() const { return revision_; }  // of the scene that the poses answer
  std::uint64_t solves() const { return solves_; }
  Nanoseconds last_solve_ns() const { return last_solve_ns_; }

  // Where a segment stands in the world; null before its figure is solved.
  const Transform* world_from_segment(const std::string& figure, int segment) const;
  // As the wire has it. Of a figure that is solved.
  proto::FigurePose message(const std::string& figure) const;

 private:
  void gather(const Scene& scene);
  std::unique_ptr<FigureGroup> make_group(const std::vector<const SceneFigure*>& figures);
  SolverOptions options(bool live_only, bool explore) const;

  std::vector<std::unique_ptr<FigureGroup>> groups_;
  std::map<std::string, Solved> figures_;
  std::optional<Method> gathered_;
  Revision revision_ = 0;
  std::uint64_t solves_ = 0;
  Nanoseconds last_solve_ns_ = 0;
};

}  // namespace posed
