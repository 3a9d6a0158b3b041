#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/server/scene/scene_fixture.h"

namespace posed {
namespace {

class Load : public SceneTest {
 protected:
  Load() {
    EXPECT_TRUE(scene.set_goal(goal_edit("g1"), {}));
    EXPECT_TRUE(scene.set_binding(binding_edit("b1", "g1"), {}));
    EXPECT_TRUE(scene.follow(frame({1, 2, 3})));
  }
};

TEST_F(Load, BringsTheWholeDocumentBack) {
  std::vector<double> q = scene.figures().at("body").q;
  q[0] = 0.125;
  ASSERT_TRUE(scene.set_q("body", q, {}));
  const SceneDocument document = scene.document();
  Scene other;
  ASSERT_TRUE(other.load(document));
  EXPECT_EQ(proto::encode_scene(other.document()), proto::encode_scene(document));
  EXPECT_EQ(other.figures().at("body").q, q);
  EXPECT_EQ(other.revision(), 1u);
  EXPECT_EQ(other.goals().at("g1").revision, 1u);
  EXPECT_TRUE(other.follow(frame({3, 2, 1})));
}

TEST_F(Load, CountsOnFromTheSceneThatWas) {
  const Revision before = scene.revision();
  ASSERT_TRUE(scene.load(SceneDocument{}));
  EXPECT_EQ(scene.revision(), before + 1);
  EXPECT_TRUE(scene.figures().empty());
  EXPECT_TRUE(scene.goals().empty());
  EXPECT_TRUE(scene.bindings().empty());
}

TEST_F(Load, RefusesADocumentWhole) {
  const SceneDocument good = scene.document();
  const auto refused = [&](const char* code, const char* path, auto break_it) {
    SceneDocument document = good;
    break_it(document);
    SCOPED_TRACE(path);
    expect_refused(code, path, [&] { return scene.load(document); });
  };
  refused("out_of_range", "/figures/body/stature", [](auto& d) { d.figures["body"].stature = 9.0; });
  refused("bad_id", "/figures/a b/id", [](auto& d) { d.figures["a b"] = d.figures["body"]; });
  refused("invalid_params", "/figures/body/q", [](auto& d) { d.figures["body"].q = {1}; });
  refused("unknown_figure", "/goals/g1/figure", [](auto& d) { d.goals["g1"].figure = "bode"; });
  refused("unknown_segment", "/goals/g1/at", [](auto& d) { d.goals["g1"].at.segment = "wing"; });
  refused("out_of_range", "/goals/g1/weight", [](auto& d) { d.goals["g1"].weight = -1.0; });
  refused("bad_id", "/goals/.g/id", [](auto& d) { d.goals[".g"] = d.goals["g1"]; });
  refused("unknown_goal", "/bindings/b1/to/goal", [](auto& d) { d.bindings["b1"].to.goal = "g"; });
  refused("unknown_sensor", "/bindings/b1/sensor", [](auto& d) { d.bindings["b1"].sensor = "simulated"; });
  refused("bad_id", "/bindings/-b/id", [](auto& d) { d.bindings["-b"] = d.bindings["b1"]; });
  EXPECT_EQ(target("g1"), Vec3(1, 2, 3));
}

// An edit can't make two bindings of one goal, so a document can't either.
TEST_F(Load, RefusesTwoBindingsOfOneGoal) {
  SceneDocument document = scene.document();
  document.bindings["b2"] = document.bindings["b1"];
  document.bindings["b2"].sensor = "simulated:2";
  expect_refused("invalid_params", "/bindings/b2/to/goal", [&] { return scene.load(document); });
}

// An error's path is a JSON pointer, and does not echo all that was sent.
TEST_F(Load, PathsAreEscapedAndShort) {
  SceneDocument document;
  document.figures["a/b~c"] = tempus_entry("a/b~c");
  EXPECT_EQ(scene.load(document).error().path, "/figures/a~1b~0c/id");
  document = {};
  document.figures[std::string(100'000, 'x')] = tempus_entry("x");
  EXPECT_LT(scene.load(document).error().path.size(), 200u);
}

TEST_F(Load, TakesTheIdsFromTheKeys) {
  SceneDocument document;
  document.figures["body"] = tempus_entry("");
  ASSERT_TRUE(scene.load(document));
  EXPECT_EQ(scene.figures().at("body").entry.id, "body");
  EXPECT_TRUE(scene.set_q("body", scene.figures().at("body").q, {}));
}

TEST_F(Load, TakesEveryTemplate) {
  int templates = 0;
  const std::filesystem::path folder = POSED_SOURCE_DIR "/server/scene/templates";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path().filename());
    std::ifstream file(entry.path());
    const Result<SceneDocument> document = proto::decode_scene(std::string(std::istreambuf_iterator<char>(file), {}));
    ASSERT_TRUE(document) << document.error().message << document.error().path;
    const Status loaded = scene.load(*document);
    EXPECT_TRUE(loaded) << loaded.error().message << loaded.error().path;
    ++templates;
  }
  EXPECT_GE(templates, 10);
}

}  // namespace
}  // namespace posed
