#include "server/daemon/apply.h"

#include <algorithm>

#include "server/scene/errors.h"
#include "server/scene/joint_value.h"
#include "server/scene/mirror.h"
#include "server/solver/tempus.h"

namespace posed {

Result<Edited> apply(Scene& scene, const proto::FigureSet& m, IfRevision if_revision) {
  FigureEntry entry;
  if (const auto found = scene.figures().find(m.id); found != scene.figures().end()) entry = found->second.entry;
  entry.id = m.id;
  if (m.document) {
    entry.template_name.clear();
    entry.document = m.document;
  }
  if (m.template_name.value()) entry.document.reset();
  m.template_name.apply(entry.template_name);
  if (m.document && m.template_name.value()) entry.document = m.document;  // the scene says what is wrong with both
  m.stature.apply(entry.stature, FigureEntry{}.stature);
  m.label.apply(entry.label);
  m.user.apply(entry.user);
  return scene.set_figure(std::move(entry), if_revision);
}

Result<Edited> apply(Scene& scene, const proto::FigureRemove& m, IfRevision if_revision) {
  return scene.remove_figure(m.id, if_revision);
}

Result<Edited> apply(Scene& scene, const proto::FigurePin& m, IfRevision if_revision) {
  return scene.pin(m.figure, m.segment, m.hold, if_revision);
}

Result<Edited> apply(Scene& scene, const proto::GoalSet& m, IfRevision if_revision) {
  return scene.set_goal(m.edit, if_revision);
}

Result<Edited> apply(Scene& scene, const proto::GoalRemove& m, IfRevision if_revision) {
  return scene.remove_goal(m.id, if_revision);
}

Result<Edited> apply(Scene& scene, const proto::ObjectSet& m, IfRevision if_revision) {
  return scene.set_object(m.edit, if_revision);
}

Result<Edited> apply(Scene& scene, const proto::ObjectRemove& m, IfRevision if_revision) {
  return scene.remove_object(m.id, if_revision);
}

Result<Edited> apply(Scene& scene, const proto::BindingSet& m, IfRevision if_revision) {
  return scene.set_binding(m.edit, if_revision);
}

Result<Edited> apply(Scene& scene, const proto::BindingRemove& m, IfRevision if_revision) {
  return scene.remove_binding(m.id, if_revision);
}

Result<Edited> apply(Scene& scene, const proto::CameraSet& m, IfRevision if_revision) {
  return scene.set_camera(m.edit, if_revision);
}

Result<Edited> apply(Scene& scene, const proto::CameraRemove& m, IfRevision if_revision) {
  return scene.remove_camera(m.id, if_revision);
}

std::string hold_of(const std::string& figure, const std::string& joint) {
  return figure + "." + joint + ".hold";
}

Result<int> joint_of(const BodyTree& tree, const std::string& name) {
  Result<int> joint = find_joint(tree, name);
  if (!joint) joint.error().path = "/joint";
  return joint;
}

namespace {

constexpr int kHoldPriority = -100;  // before all goals but those that say the same

// What holds a joint is a posture goal like others: undone, kept and listed as they are. One that is there takes the
// joint's new value.
Status hold_joint(Scene& scene, const std::string& figure, const proto::JointSet& m, const JointValue& value) {
  const std::string id = hold_of(figure, m.joint);
  const bool is_held = scene.goals().contains(id);
  if (m.hold.is_reset()) {
    if (!is_held) return Ok{};
    const Result<Edited> removed = scene.remove_goal(id, {});
    if (!removed) return below("/hold", removed.error());
    return Ok{};
  }
  if (!m.hold.value() && !is_held) return Ok{};
  GoalEdit edit;
  edit.id = id;
  edit.figure = figure;
  edit.posture = PostureTarget{"", {{m.joint, value}}};
  if (const proto::JointHold* hold = m.hold.value()) {
    edit.weight = GoalWeight(hold->weight.value_or(GoalWeight().value));
    edit.priority = hold->weight ? 0 : kHoldPriority;
  }
  const Result<Edited> set = scene.set_goal(edit, {});
  if (!set) return Error{set.error().code, set.error().message, "/hold", set.error().hint};
  return Ok{};
}

}  // namespace

Result<Edited> apply(Scene& scene, const proto::JointSet& m, IfRevision if_revision) {
  const Result<const SceneFigure*> figure = scene.find_figure(m.figure);
  if (!figure) return figure.error();
  const BodyTree& tree = *(*figure)->tree;
  const Result<int> joint = joint_of(tree, m.joint);
  if (!joint) return joint.error();
  const std::string id = (*figure)->entry.id;
  std::vector<double> q = (*figure)->q;
  const JointValue value{m.value, m.halfplane, m.deviation, m.twist};
  if (!value.share.empty() || value.oriented() || !m.hold.named()) {
    Result<std::vector<double>> share = joint_share(tree, *joint, value);
    if (!share) {
      if (share.error().path.empty()) share.error().path = "/value";
      return share.error();
    }
    std::copy(share->begin(), share->end(), q.begin() + tree.q_at(*joint));
  }
  const auto first = q.begin() + tree.q_at(*joint);
  const JointValue held{{first, first + q_size(tree.joint(*joint).type)}, {}, {}, {}};
  Result<Edited> edited = scene.set_q(id, std::move(q), if_revision);
  if (!edited) return edited;
  const Status hold = hold_joint(scene, id, m, held);
  if (!hold) return hold.error();
  edited->revision = scene.revision();
  return edited;
}

Result<Edited> apply(Scene& scene, const proto::PoseSet& m, IfRevision if_revision) {
  return scene.set_q(m.figure, m.q, if_revision);
}

Result<Edited> apply(Scene& scene, const proto::PoseReset& m, IfRevision if_revision) {
  const Result<const SceneFigure*> figure = scene.find_figure(m.figure);
  if (!figure) return figure.error();
  const BodyTree& tree = *(*figure)->tree;
  return scene.set_q((*figure)->entry.id, m.to == "start" ? start_pose(tree) : tree.rest(), if_revision);
}

Result<Edited> apply(Scene& scene, const proto::PoseMirror& m, IfRevision if_revision) {
  const Result<const SceneFigure*> figure = scene.find_figure(m.figure);
  if (!figure) return figure.error();
  return scene.set_q((*figure)->entry.id, mirrored(*(*figure)->tree, (*figure)->q), if_revision);
}

Result<proto::ClearResult> apply(Scene& scene, const proto::GoalClear& m, IfRevision) {
  if (!m.figure.empty()) {
    if (const auto figure = scene.find_figure(m.figure); !figure) return figure.error();
  }
  const int removed = scene.clear_goals(m.figure);
  return proto::ClearResult{removed, scene.revision()};
}

namespace {

proto::AppliedResult applied(const Edited& edited) {
  proto::AppliedResult result;
  static_cast<proto::EditResult&>(result) = {edited.id, edited.revision, edited.entity_revision};
  return result;
}
proto::AppliedResult applied(const proto::ClearResult& cleared) {
  proto::AppliedResult result;
  result.removed = cleared.removed;
  result.revision = cleared.revision;
  return result;
}
proto::AppliedResult applied(const proto::ApplyResult&) {
  return {};
}

}  // namespace

Result<proto::ApplyResult> apply(Scene& scene, const proto::EditApply& m, IfRevision) {
  proto::ApplyResult all;
  for (std::size_t i = 0; i < m.edits.size(); ++i) {
    const auto one = [&](const auto& message) -> Result<proto::AppliedResult> {
      if constexpr (Applied<std::decay_t<decltype(message)>>) {
        const auto result = apply(scene, message, m.edits[i].if_revision);
        if (!result) return result.error();
        return applied(*result);
      } else {
        return Error{"invalid_params", "it is no edit", "/method", ""};
      }
    };
    Result<proto::AppliedResult> result = std::visit(one, m.edits[i].params);
    if (!result) return below("/edits/" + std::to_string(i) + "/params", result.error());
    all.results.push_back(std::move(*result));
  }
  all.revision = scene.revision();
  return all;
}

}  // namespace posed
