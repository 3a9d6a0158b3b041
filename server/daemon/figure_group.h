// Figures that are solved as one: those that goals tie together, or one alone. Calls the solver, and has the answer in
// the words of the wire. One thread at a time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/pose.h"
#include "common/time.h"
#include "proto/messages.h"
#include "server/scene/scene.h"
#include "server/solver/reach_tree_solver.h"
#include "server/solver/springs/spring_solver.h"

namespace posed {

enum class Method { springs, reach_tree };
const char* name_of(Method method);
// Errors: "invalid_params", path "/method".
Result<Method> find_method(const std::string& name);

struct SolverOptions {
  SpringOptions springs;
  ReachTreeOptions reach_tree;
};

class FigureGroup {
 public:
  // Makes the solver. `reach_tree` takes one figure only.
  FigureGroup(Method method, std::vector<std::shared_ptr<const BodyTree>> trees);

  // What is solved from now on: the figures of these trees, in that order; the answer keeps the order of the goals.
  // Both must stay where they are until the last `solve`; what the answer names is copied.
  void set(std::vector<const SceneFigure*> figures, std::vector<const SceneGoal*> goals,
           std::vector<const SceneBinding*> joints = {});  // bindings to joints of these figures
  bool live() const;                                       // sensors move some of the goals or joints
  // From the figures' present q. Once it has solved these goals it does not allocate.
  void solve(const SolverOptions& options, const std::function<bool()>& should_stop);

  Method method() const { return method_; }
  const std::vector<std::shared_ptr<const BodyTree>>& trees() const { return trees_; }
  const std::vector<std::string>& ids() const { return ids_; }

  // ---- the answer ----
  const std::vector<double>& q(std::size_t figure) const { return pose_.q[figure]; }
  const SolveReport& report() const { return pose_.report; }  // of all figures together
  const std::vector<Transform>& world_from_segment(std::size_t figure) const {
    return pose_.world_from_segment[figure];
  }
  proto::FigurePose message(std::size_t figure) const;
  std::vector<std::string> notes() const;  // what the method makes of the goals, and does not do
  double moved() const;                    // what the solve changed most among the values of q, roots apart

 private:
  // Whose reports pose_.goals are: the goals, then the pins, then joints that sensors move.
  struct Puller {
    enum class Kind { goal, pin, binding };
    std::string id;  // of a pin: the segment
    std::size_t figure = 0;
    Kind kind = Kind::goal;
  };

  std::size_t index_of(const std::string& figure) const;
  void set_springs();
  void set_reach_tree();
  proto::GoalFrame::Because because(const Cause& cause, std::size_t figure) const;

  const Method method_;
  const std::vector<std::shared_ptr<const BodyTree>> trees_;
  std::unique_ptr<SpringSolver> spring_solver_;
  std::unique_ptr<ReachTreeSolver> reach_solver_;
  std::vector<std::string> ids_;
  std::vector<const SceneFigure*> figures_;
  std::vector<const SceneGoal*> goals_;
  std::vector<Puller> pullers_;
  std::vector<const SceneBinding*> joints_;
  std::vector<SpringGoal> springs_;  // of goals, then of pins, then of joints
  std::vector<ReachGoal> reaches_;
  std::vector<std::string> reach_notes_;
  SpringPose pose_;
  Pose reach_pose_;  // its memory is exchanged with pose_
  std::vector<std::vector<double>> before_;
};

}  // namespace posed
