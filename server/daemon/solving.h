// Poses of all figures: keeps a solver for each, and calls it where goals have moved. Station loop only.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/pose.h"
#include "common/time.h"
#include "proto/messages.h"
#include "server/scene/scene.h"
#include "server/solver/reach_tree_solver.h"

namespace posed {

// The method `springs` is refused while this is false.
inline constexpr bool kSpringsAvailable = false;

struct SolvedFigure {
  std::unique_ptr<ReachTreeSolver> solver;
  std::vector<const SceneGoal*> sources;  // in the order of pose.goals
  std::vector<ReachGoal> goals;
  std::vector<std::string> notes;  // what the method makes of the figure and does not do
  std::vector<double> q;
  Pose pose;
  Nanoseconds solve_ns = 0;
};

class Solving {
 public:
  std::string method = "reach_tree";
  ReachTreeOptions options;
  Nanoseconds deadline_ns = 20'000'000;

  // Solves every figure from its present q, or those only that a live goal pulls at, and hands q back to the scene.
  void solve(Scene& scene, bool live_only, const Clock& clock);

  const std::map<std::string, SolvedFigure>& figures() const { return figures_; }
  Revision revision() const { return revision_; }  // of the scene that the poses answer
  std::uint64_t solves() const { return solves_; }
  Nanoseconds last_solve_ns() const { return last_solve_ns_; }

  // As the wire has it. Of a figure that is solved.
  proto::FigurePose message(const std::string& figure) const;

 private:
  void gather(const Scene& scene);

  std::map<std::string, SolvedFigure> figures_;
  Revision revision_ = 0;
  std::uint64_t solves_ = 0;
  Nanoseconds last_solve_ns_ = 0;
};

}  // namespace posed
