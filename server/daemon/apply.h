// Edits as messages, done to the scene: one function a message. Errors: paths begin at the message ("/at").
#pragma once

#include "proto/messages.h"
#include "server/scene/scene.h"

namespace posed {

Result<Edited> apply(Scene& scene, const proto::FigureSet& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::FigureRemove& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::FigurePin& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::GoalSet& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::GoalRemove& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::ObjectSet& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::ObjectRemove& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::BindingSet& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::BindingRemove& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::CameraSet& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::CameraRemove& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::JointSet& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::PoseSet& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::PoseReset& m, IfRevision if_revision);
Result<Edited> apply(Scene& scene, const proto::PoseMirror& m, IfRevision if_revision);
Result<proto::ClearResult> apply(Scene& scene, const proto::GoalClear& m, IfRevision);
// All edits, or none of them where one fails, if the scene keeps what was (Scene::begin). Errors: "/edits/3/params/at".
Result<proto::ApplyResult> apply(Scene& scene, const proto::EditApply& m, IfRevision);

// The posture goal that holds a joint: FIGURE.JOINT.hold.
std::string hold_of(const std::string& figure, const std::string& joint);
// "/joint" where the figure has no such joint.
Result<int> joint_of(const BodyTree& tree, const std::string& name);

template <class Message>
concept Applied = requires(Scene& scene, const Message& m) {
  apply(scene, m, IfRevision{});
};

}  // namespace posed
