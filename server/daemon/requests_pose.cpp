// Joints, poses and the solver.
#include <algorithm>

#include "common/names.h"
#include "server/daemon/requests.h"
#include "server/scene/mirror.h"
#include "server/solver/orientation.h"
#include "server/solver/tempus.h"

namespace posed {
namespace {

Result<int> find_joint(const BodyTree& tree, const std::string& name) {
  if (const auto joint = tree.find_joint(name)) return *joint;
  std::vector<std::string> known;
  known.reserve(static_cast<std::size_t>(tree.size()));
  for (int i = 0; i < tree.size(); ++i) known.push_back(tree.joint(i).name);
  return Error{"unknown_joint", "no joint is called " + name.substr(0, 64), "/joint", did_you_mean(name, known)};
}

bool turns(JointType type) {
  return type == JointType::ball || type == JointType::universal;
}

// The joint's new share of q.
Result<std::vector<double>> share_of(const proto::JointSet& m, const BodyTree& tree, int joint) {
  const JointType type = tree.joint(joint).type;
  const auto size = static_cast<std::size_t>(q_size(type));
  const bool orientation = m.halfplane || m.deviation || m.twist;
  if (orientation == !m.value.empty()) {
    return Error{"invalid_params", "a joint is set either by value or by halfplane, deviation and twist", "/value",
                 "give one of the two"};
  }
  if (!orientation) {
    if (m.value.size() == size) return m.value;
    return Error{"wrong_type", "the joint takes " + std::to_string(size) + " numbers", "/value",
                 "figure.get tells its type in q_layout"};
  }
  if (!turns(type)) return Error{"invalid_params", "the joint has no free orientation", "/halfplane", "set its value"};
  const Orientation o{m.halfplane.value_or(0.0), m.deviation.value_or(0.0), m.twist.value_or(0.0)};
  if (o.deviation < 0.0 || o.deviation > M_PI)
    return Error{"out_of_range", "the deviation is out of range", "/deviation", "0 to pi"};
  const auto q = xyzw(quat_from_orientation(o, tree.segment(joint).touch_point));
  return std::vector<double>(q.begin(), q.end());
}

}  // namespace

void Requests::on(const proto::JointSet& m, Responder responder) {
  const Result<const SceneFigure*> figure = p_.scene.find_figure(m.figure);
  if (!figure) return responder.params_error(figure.error());
  const BodyTree& tree = *(*figure)->tree;
  const Result<int> joint = find_joint(tree, m.joint);
  if (!joint) return responder.params_error(joint.error());
  const Result<std::vector<double>> share = share_of(m, tree, *joint);
  if (!share) return responder.params_error(share.error());
  std::vector<double> q = (*figure)->q;
  std::copy(share->begin(), share->end(), q.begin() + tree.q_at(*joint));
  answer(p_.scene.set_q((*figure)->entry.id, std::move(q), if_revision_), responder);
}

void Requests::on(const proto::JointGet& m, Responder responder) {
  const Result<const SceneFigure*> figure = p_.scene.find_figure(m.figure);
  if (!figure) return responder.params_error(figure.error());
  const BodyTree& tree = *(*figure)->tree;
  const Result<int> joint = find_joint(tree, m.joint);
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

void Requests::on(const proto::PoseSet& m, Responder responder) {
  answer(p_.scene.set_q(m.figure, m.q, if_revision_), responder);
}

void Requests::on(const proto::PoseReset& m, Responder responder) {
  const Result<const SceneFigure*> figure = p_.scene.find_figure(m.figure);
  if (!figure) return responder.params_error(figure.error());
  const BodyTree& tree = *(*figure)->tree;
  answer(p_.scene.set_q((*figure)->entry.id, m.to == "start" ? start_pose(tree) : tree.rest(), if_revision_),
         responder);
}

void Requests::on(const proto::PoseMirror& m, Responder responder) {
  const Result<const SceneFigure*> figure = p_.scene.find_figure(m.figure);
  if (!figure) return responder.params_error(figure.error());
  answer(p_.scene.set_q((*figure)->entry.id, mirrored(*(*figure)->tree, (*figure)->q), if_revision_), responder);
}

void Requests::on(const proto::SolverGet&, Responder responder) {
  const ReachTreeOptions& options = p_.solving.options;
  responder.result(proto::SolverResult{"reach_tree", options.root_iterations, options.branch_iterations});
}

void Requests::on(const proto::SolverSet& m, Responder responder) {
  if (const std::string* method = m.method.value(); method && *method != "reach_tree") {
    if (*method == "springs") {
      return responder.error({"not_available", "the method springs is reserved: this daemon does not do it yet",
                              "/params/method", "use reach_tree"});
    }
    return responder.error(
        {"invalid_params", "no method is called " + method->substr(0, 64), "/params/method", "use reach_tree"});
  }
  ReachTreeOptions options = p_.solving.options;
  m.iterations.apply(options.root_iterations, ReachTreeOptions{}.root_iterations);
  m.branch_iterations.apply(options.branch_iterations, ReachTreeOptions{}.branch_iterations);
  if (options.root_iterations < 1 || options.root_iterations > 100'000) {
    return responder.error({"out_of_range", "the number of iterations is out of range", "/params/iterations",
                            "1 to 100000; the default is 200"});
  }
  if (options.branch_iterations < 1 || options.branch_iterations > 100) {
    return responder.error({"out_of_range", "the number of iterations is out of range", "/params/branch_iterations",
                            "1 to 100; the default is 1"});
  }
  p_.solving.options = options;
  responder.result(proto::SolverResult{"reach_tree", options.root_iterations, options.branch_iterations});
  p_.resolve();
}

}  // namespace posed
