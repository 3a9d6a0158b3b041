#include "tests/server/scene/scene_fixture.h"

namespace posed {
namespace {

class CameraEdits : public SceneTest {
 protected:
  static CameraEdit camera_edit(std::string id, GoalBase base = {}) {
    CameraEdit edit;
    edit.id = std::move(id);
    edit.position = Vec3(1, 2, 3);
    edit.relative_to = std::move(base);
    return edit;
  }
  const SceneCamera& camera(const std::string& id) const { return scene.cameras().at(id); }
};

TEST_F(CameraEdits, OnlyTheNamedFieldsChangeAndNullRestores) {
  CameraEdit first = camera_edit("main");
  first.rotation = quat_about(kZ, 1.0);
  first.fov_y = 0.5;
  first.label = std::string("door");
  expect_edited("main", 1, [&] { return scene.set_camera(first, {}); });
  CameraEdit second;
  second.id = "main";
  second.fov_y = 0.7;
  expect_edited("main", 2, [&] { return scene.set_camera(second, {}); });
  EXPECT_EQ(camera("main").camera.base_from_camera.position, Vec3(1, 2, 3));
  EXPECT_EQ(camera("main").camera.fov_y, 0.7);
  second.fov_y = Patched<double>::reset();
  second.rotation = Patched<Quat>::reset();
  second.label = Patched<std::string>::reset();
  ASSERT_TRUE(scene.set_camera(second, {}));
  EXPECT_EQ(camera("main").camera.fov_y, kDefaultFovY);
  EXPECT_EQ(camera("main").camera.base_from_camera.rotation, quat_identity());
  EXPECT_EQ(camera("main").camera.label, "");
}

TEST_F(CameraEdits, WhatIsWrongIsTold) {
  expect_refused("bad_id", "/id", [&] { return scene.set_camera(camera_edit("a b"), {}); });
  for (const double fov : {0.0, -1.0, M_PI, std::nan("")}) {
    CameraEdit edit = camera_edit("main");
    edit.fov_y = fov;
    expect_refused("out_of_range", "/fov_y", [&] { return scene.set_camera(edit, {}); });
  }
  CameraEdit far = camera_edit("main");
  far.position = Vec3(0, 2e6, 0);
  expect_refused("out_of_range", "/position/1", [&] { return scene.set_camera(far, {}); });
  CameraEdit turned = camera_edit("main");
  turned.rotation = Quat(2, 0, 0, 0);
  expect_refused("invalid_params", "/quat_xyzw", [&] { return scene.set_camera(turned, {}); });
  using Kind = GoalBase::Kind;
  expect_refused("unknown_segment", "/relative_to/segment", [&] {
    return scene.set_camera(camera_edit("main", {Kind::segment, "", "haed", ""}), {});
  });
  expect_refused("unknown_figure", "/relative_to/figure", [&] {
    return scene.set_camera(camera_edit("main", {Kind::segment, "ana", "head", ""}), {});
  });
  expect_refused("unknown_sensor", "/relative_to/sensor", [&] {
    return scene.set_camera(camera_edit("main", {Kind::sensor, "", "", "liberty"}), {});
  });
  expect_refused("unknown_object", "/relative_to/object", [&] {
    return scene.set_camera(camera_edit("main", {Kind::object, "", "", "", "chair"}), {});
  });
  expect_refused("unknown_camera", "/id", [&] { return scene.remove_camera("main", {}); });
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.set_camera(camera_edit("main"), 3); });
}

TEST_F(CameraEdits, WhatACameraIsRelativeToStays) {
  ObjectEdit chair;
  chair.id = "chair";
  ASSERT_TRUE(scene.set_object(chair, {}));
  ASSERT_TRUE(scene.set_camera(camera_edit("eyes", {GoalBase::Kind::segment, "", "head", ""}), {}));
  EXPECT_EQ(camera("eyes").camera.relative_to.figure, "body") << "what was left out is said";
  ASSERT_TRUE(scene.set_camera(camera_edit("seat", {GoalBase::Kind::object, "", "", "", "chair"}), {}));
  expect_refused("in_use", "/id", [&] { return scene.remove_object("chair", {}); });
  expect_refused("in_use", "/id", [&] { return scene.remove_figure("body", {}); });
  ASSERT_TRUE(scene.set_figure(tempus_entry("body", 1.6), {})) << "another stature has a head, too";
  expect_refused("unknown_segment", "/id", [&] { return scene.set_figure(small_entry("body"), {}); });
  chair.position = Vec3(5, 0, 0);
  ASSERT_TRUE(scene.set_object(chair, {}));
  EXPECT_EQ(camera("seat").world_from_base->position, Vec3(5, 0, 0));
}

TEST_F(CameraEdits, ABoundCameraFollowsAndStaysWhereItIsLetGo) {
  ASSERT_TRUE(scene.set_camera(camera_edit("main"), {}));
  BindingEdit edit;
  edit.id = "eye";
  edit.sensor = "simulated:1";
  edit.to = BindingTarget{"", "", "main", "", ""};
  ASSERT_TRUE(scene.set_binding(edit, {}));
  EXPECT_EQ(scene.bindings().at("eye").binding.axes, kAllAxes);
  const Revision revision = scene.revision();
  Frame moved = frame({4, 5, 6});
  moved.samples[0].rotation = quat_about(kY, 0.5);
  const Revision came = camera("main").revision;
  const Scene::Followed followed = scene.follow(moved);
  EXPECT_TRUE(followed.cameras);
  EXPECT_FALSE(followed.pose) << "no figure is pulled: nothing to solve";
  EXPECT_FALSE(scene.follow(moved));
  EXPECT_EQ(camera("main").live->position, Vec3(4, 5, 6));
  EXPECT_EQ(camera("main").live->rotation, quat_about(kY, 0.5));
  EXPECT_EQ(scene.revision(), revision);
  EXPECT_EQ(camera("main").camera.base_from_camera.position, Vec3(1, 2, 3)) << "live motion is no edit";
  expect_refused("invalid_params", "/relative_to", [&] {
    return scene.set_camera(camera_edit("main", {GoalBase::Kind::segment, "", "head", ""}), {});
  });
  ASSERT_TRUE(scene.remove_binding("eye", {}));
  EXPECT_EQ(camera("main").camera.base_from_camera.position, Vec3(4, 5, 6));
  EXPECT_EQ(camera("main").revision, came + 1);
  ASSERT_TRUE(scene.set_binding(edit, {}));
  expect_edited("main", 0, [&] { return scene.remove_camera("main", {}); });
  EXPECT_TRUE(scene.bindings().empty()) << "what is bound to it goes with it";
}

TEST_F(CameraEdits, ACameraRelativeToASensorRidesOnIt) {
  ASSERT_TRUE(scene.set_camera(camera_edit("wand", {GoalBase::Kind::sensor, "", "", "simulated:2"}), {}));
  EXPECT_FALSE(camera("wand").world_from_base) << "not heard yet";
  EXPECT_FALSE(scene.follow(frame({9, 9, 9}, 1)));
  EXPECT_TRUE(scene.follow(frame({9, 9, 9}, 2)).cameras);
  EXPECT_EQ(camera("wand").world_from_base->position, Vec3(9, 9, 9));
  BindingEdit edit = binding_edit("b", "");
  edit.to = BindingTarget{"", "", "wand", "", ""};
  expect_refused("not_available", "/to/camera", [&] { return scene.set_binding(edit, {}); });
}

TEST_F(CameraEdits, ComeAndGoWithTheDocumentAndWithUndo) {
  ASSERT_TRUE(scene.set_camera(camera_edit("eyes", {GoalBase::Kind::segment, "", "head", ""}), {}));
  const std::string text = proto::encode_scene(scene.document());
  Scene other;
  ASSERT_TRUE(other.load(*proto::decode_scene(text)));
  EXPECT_EQ(proto::encode_scene(other.document()), text);
  SceneDocument broken = scene.document();
  broken.cameras.at("eyes").relative_to.segment = "haed";
  const Status refused = other.load(broken);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().path, "/cameras/eyes/relative_to/segment");

  scene.begin();
  ASSERT_TRUE(scene.remove_camera("eyes", {}));
  Change removed = scene.commit();
  EXPECT_EQ(removed.entities(), std::vector<std::string>{"/cameras/eyes"});
  EXPECT_FALSE(scene.revert(removed)) << "no conflict";
  EXPECT_EQ(proto::encode_scene(scene.document()), text);
  EXPECT_FALSE(scene.revert(removed));
  EXPECT_TRUE(scene.cameras().empty());
  scene.begin();
  ASSERT_TRUE(scene.set_camera(camera_edit("eyes"), {}));
  scene.rollback();
  EXPECT_TRUE(scene.cameras().empty());
}

TEST_F(CameraEdits, ACameraIsNotBroughtBackToAFigureThatIsGone) {
  ASSERT_TRUE(scene.set_figure(small_entry("small"), {}));
  ASSERT_TRUE(scene.set_camera(camera_edit("eyes", {GoalBase::Kind::segment, "small", "tip", ""}), {}));
  scene.begin();
  ASSERT_TRUE(scene.remove_camera("eyes", {}));
  Change removed = scene.commit();
  ASSERT_TRUE(scene.remove_figure("small", {}));
  const auto conflict = scene.revert(removed);
  ASSERT_TRUE(conflict);
  EXPECT_EQ(conflict->path, "/figures/small");
  EXPECT_TRUE(scene.cameras().empty());
}

}  // namespace
}  // namespace posed
