// Joints, poses and the solver.
#include <algorithm>

#include "server/daemon/requests.h"
#include "server/scene/joint_value.h"
#include "server/solver/orientation.h"

namespace posed {
namespace {

proto::SolverResult message(const Solving& solving) {
  return {name_of(solving.method), solving.iterations, solving.branch_iterations};
}

}  // namespace

void Requests::on(const proto::JointGet& m, Responder responder) {
  const Result<const SceneFigure*> figure = p_.scene.find_figure(m.figure);
  if (!figure) return responder.params_error(figure.error());
  const BodyTree& tree = *(*figure)->tree;
  const Result<int> joint = joint_of(tree, m.joint);
  if (!joint) return responder.params_error(joint.error());
  proto::JointResult result;
  result.figure = (*figure)->entry.id;
  result.joint = m.joint;
  result.type = tree.joint(*joint).type;
  const auto begin = (*figure)->q.begin() + tree.q_at(*joint);
  result.value.assign(begin, begin + q_size(result.type));
  if (turns(result.type)) {
    const Orientation o = orientation_from_quat(quat_from_xyzw(result.value), tree.segment(*joint).touch_point);
    result.halfplane = o.halfplane;
    result.deviation = o.deviation;
    result.twist = o.twist;
  }
  const auto hold = p_.scene.goals().find(hold_of(result.figure, m.joint));
  if (hold != p_.scene.goals().end()) {
    result.hold.emplace();
    if (hold->second.goal.priority == 0) result.hold->weight = hold->second.goal.weight.value;
  }
  responder.result(result);
}

void Requests::on(const proto::PoseGet& m, Responder responder) {
  const Result<const SceneFigure*> figure = p_.scene.find_figure(m.figure);
  if (!figure) return responder.params_error(figure.error());
  // An edit of this very line may not be solved yet: what is asked for now is the pose of the present scene.
  const Revision revision = m.min_revision.value_or(p_.scene.revision());
  const Nanoseconds wait = m.min_revision ? Nanoseconds{m.wait_ms} * 1'000'000 : 1'000'000'000;
  p_.answer_pose((*figure)->entry.id, revision, wait, std::move(responder));
}

void Requests::on(const proto::SolverGet&, Responder responder) {
  responder.result(message(p_.solving));
}

void Requests::on(const proto::SolverSet& m, Responder responder) {
  std::string method = name_of(p_.solving.method);
  m.method.apply(method, name_of(p_.default_method));
  const Result<Method> found = find_method(method);
  if (!found) return responder.params_error(found.error());
  int iterations = p_.solving.iterations, branch_iterations = p_.solving.branch_iterations;
  m.iterations.apply(iterations, Solving{}.iterations);
  m.branch_iterations.apply(branch_iterations, Solving{}.branch_iterations);
  if (iterations < 1 || iterations > 100'000) {
    return responder.error({"out_of_range", "the number of iterations is out of range", "/params/iterations",
                            "1 to 100000; the default is 200"});
  }
  if (branch_iterations < 1 || branch_iterations > 100) {
    return responder.error({"out_of_range", "the number of iterations is out of range", "/params/branch_iterations",
                            "1 to 100; the default is 1"});
  }
  p_.solving.method = *found;
  p_.solving.iterations = iterations;
  p_.solving.branch_iterations = branch_iterations;
  responder.result(message(p_.solving));
  p_.resolve();
}

}  // namespace posed
