#include "server/scene/spring_goals.h"
#include "server/solver/kinematics.h"
#include "tests/server/scene/scene_fixture.h"

namespace posed {
namespace {

class Pins : public SceneTest {
 protected:
  const std::map<std::string, Pin>& pins() const { return scene.figures().at("body").entry.pins; }
  Transform segment(const char* name) const {
    const SceneFigure& body = scene.figures().at("body");
    std::vector<Transform> world(static_cast<std::size_t>(body.tree->size()));
    forward_kinematics(*body.tree, body.q, world);
    return world[static_cast<std::size_t>(*body.tree->find_segment(name))];
  }
  void move_to(double x) {
    std::vector<double> q = scene.figures().at("body").q;
    q[0] = x;
    ASSERT_TRUE(scene.set_q("body", q, {}));
  }
};

TEST_F(Pins, HoldTheSegmentWhereItIs) {
  move_to(0.5);
  expect_edited("body", 3, [&] { return scene.pin("", "leftFoot", Pin::Hold::pose, 2); });
  ASSERT_TRUE(pins().contains("left_foot")) << "an alias pins the segment";
  const Transform foot = segment("left_foot");
  const BodyTree& tree = *scene.figures().at("body").tree;
  const int index = *tree.find_segment("left_foot");
  EXPECT_EQ(*pins().at("left_foot").position, foot * tree.segment(index).touch_point);
  EXPECT_EQ(*pins().at("left_foot").rotation, foot.rotation);
  // What is held does not go along.
  move_to(0.0);
  EXPECT_NEAR(pins().at("left_foot").position->x, 0.5 + 0.114 * 1.75, 1e-9);

  const std::vector<SpringGoal> goals = pin_goals(scene.figures().at("body"));
  ASSERT_EQ(goals.size(), 1u);
  EXPECT_EQ(goals[0].priority, kPinPriority);
  EXPECT_EQ(goals[0].at.segment, index);
  EXPECT_EQ(std::get<PoseSpring>(goals[0].spring).position, *pins().at("left_foot").position);
}

TEST_F(Pins, AreReplacedAndTakenAway) {
  ASSERT_TRUE(scene.pin("body", "head", Pin::Hold::position, {}));
  move_to(0.25);
  ASSERT_TRUE(scene.pin("body", "head", Pin::Hold::orientation, {}));
  ASSERT_EQ(pins().size(), 1u);
  EXPECT_EQ(pins().at("head").hold, Pin::Hold::orientation);
  EXPECT_NEAR(pins().at("head").position->x, 0.25, 1e-9);
  EXPECT_TRUE(std::holds_alternative<OrientationSpring>(pin_goals(scene.figures().at("body"))[0].spring));
  ASSERT_TRUE(scene.pin("body", "head", std::nullopt, {}));
  EXPECT_TRUE(pins().empty());
}

TEST_F(Pins, RefuseTheUnknownAndTheStale) {
  expect_refused("unknown_segment", "/segment", [&] { return scene.pin("", "hed", Pin::Hold::pose, {}); });
  expect_refused("unknown_figure", "/figure", [&] { return scene.pin("bod", "head", Pin::Hold::pose, {}); });
  expect_refused("revision_mismatch", "/if_revision", [&] { return scene.pin("", "head", Pin::Hold::pose, 7); });
}

TEST_F(Pins, ComeBackWithTheScene) {
  ASSERT_TRUE(scene.pin("body", "left_foot", Pin::Hold::pose, {}));
  const Vec3 held = *pins().at("left_foot").position;
  move_to(1.0);
  Scene other;
  ASSERT_TRUE(other.load(*proto::decode_scene(proto::encode_scene(scene.document()))));
  EXPECT_EQ(*other.figures().at("body").entry.pins.at("left_foot").position, held);
}

TEST_F(Pins, OfADocumentMayLeaveThePlaceOut) {
  SceneDocument document = scene.document();
  document.figures["body"].pins["left_foot"] = {Pin::Hold::pose, {}, {}};
  ASSERT_TRUE(scene.load(document));
  EXPECT_NEAR(pins().at("left_foot").position->z, 0.0, 1e-9);
  const auto refused = [&](const char* code, const char* path, auto spoil) {
    SceneDocument bad = document;
    spoil(bad.figures["body"].pins);
    expect_refused(code, path, [&] { return scene.load(bad); });
  };
  refused("unknown_segment", "/figures/body/pins/left_fot", [](auto& p) { p["left_fot"] = {}; });
  refused("invalid_params", "/figures/body/pins/left_foot", [](auto& p) { p["leftFoot"] = {}; });
  refused("out_of_range", "/figures/body/pins/head/position/1", [](auto& p) {
    p["head"] = {Pin::Hold::pose, Vec3(0, 1e7, 0), {}};
  });
  refused("invalid_params", "/figures/body/pins/head/quat_xyzw", [](auto& p) {
    p["head"] = {Pin::Hold::pose, {}, Quat(2, 0, 0, 0)};
  });
}

TEST_F(Pins, StayWithAnotherFigureWhereTheirSegmentsDo) {
  ASSERT_TRUE(scene.pin("body", "left_foot", Pin::Hold::pose, {}));
  ASSERT_TRUE(scene.pin("body", "head", Pin::Hold::pose, {}));
  const Vec3 held = *pins().at("left_foot").position;
  ASSERT_TRUE(scene.set_figure(tempus_entry("body", 1.5), {}));
  EXPECT_EQ(pins().size(), 2u);
  EXPECT_EQ(*pins().at("left_foot").position, held);
  ASSERT_TRUE(scene.set_figure(small_entry("body", "head"), {}));
  EXPECT_EQ(pins().size(), 1u);
  EXPECT_TRUE(pins().contains("head"));
}

}  // namespace
}  // namespace posed
