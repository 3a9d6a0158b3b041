// A scene with the built-in figure, and a watch that refused edits change nothing.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

#include "proto/codec.h"
#include "server/scene/scene.h"
#include "server/solver/tempus.h"

namespace posed {

class SceneTest : public ::testing::Test {
 protected:
  SceneTest() {
    expect_edited("body", 1, [&] { return scene.set_figure(tempus_entry("body"), {}); });
  }

  static FigureEntry tempus_entry(std::string id, double stature = 1.75) {
    FigureEntry entry;
    entry.id = std::move(id);
    entry.template_name = "tempus";
    entry.stature = stature;
    return entry;
  }

  // A figure of two segments; the second is called `child`.
  static FigureEntry small_entry(std::string id, const std::string& child = "tip") {
    FigureDocument document;
    document.root = "base";
    Segment base, tip;
    base.name = "base";
    base.joint.name = "base_joint";
    base.joint.type = JointType::fixed;
    tip.name = child;
    tip.parent = "base";
    tip.joint.name = "tip_joint";
    tip.joint.type = JointType::ball;
    tip.touch_point = {0, 0, 0.5};
    document.segments = {base, tip};
    FigureEntry entry;
    entry.id = std::move(id);
    entry.document = document;
    return entry;
  }

  static GoalEdit goal_edit(std::string id, std::string segment = "right_hand", Vec3 position = {0.4, -0.3, 1.2}) {
    GoalEdit edit;
    edit.id = std::move(id);
    edit.at = Attachment{std::move(segment), {}, ""};
    edit.position = position;
    return edit;
  }

  static BindingEdit binding_edit(std::string id, std::string goal, std::string sensor = "simulated:1") {
    BindingEdit edit;
    edit.id = std::move(id);
    edit.sensor = std::move(sensor);
    edit.to = BindingTarget{std::move(goal), "", "", "", ""};
    return edit;
  }

  static Frame frame(Vec3 position, int station = 1) {
    Frame frame;
    frame.device = "simulated";
    frame.samples.push_back({});
    frame.samples[0].station = station;
    frame.samples[0].position = position;
    return frame;
  }

  Vec3 target(const std::string& goal) const { return scene.goals().at(goal).target(); }
  const Goal& goal(const std::string& id) const { return scene.goals().at(id).goal; }

  const Vec3& position(const std::string& id) const { return *position_of(goal(id).payload); }

  // All that an edit could change, as text.
  std::string snapshot() const {
    std::ostringstream text;
    text << proto::encode_scene(scene.document(), 1) << "\nscene " << scene.revision() << '\n';
    for (const auto& [id, figure] : scene.figures()) text << id << ' ' << figure.revision << '\n';
    for (const auto& [id, goal] : scene.goals()) {
      text << id << ' ' << goal.revision << ' ' << goal.at.segment << ' ' << goal.target().x << '\n';
    }
    for (const auto& [id, binding] : scene.bindings()) text << id << ' ' << binding.revision << '\n';
    return text.str();
  }

  // `edit` must fail with this code and path, and change nothing.
  template <class F>
  void expect_refused(const char* code, const char* path, F edit) {
    const std::string before = snapshot();
    const auto result = edit();
    ASSERT_FALSE(result) << code;
    EXPECT_EQ(result.error().code, code) << result.error().message;
    EXPECT_EQ(result.error().path, path) << result.error().message;
    EXPECT_FALSE(result.error().message.empty());
    EXPECT_FALSE(result.error().hint.empty()) << result.error().message;
    EXPECT_EQ(snapshot(), before) << code;
  }

  // `edit` must succeed, count the scene up by one, and be the entity's nth; with the first it comes.
  template <class F>
  void expect_edited(const char* id, Revision nth, F edit) {
    const Revision before = scene.revision();
    const Result<Edited> edited = edit();
    ASSERT_TRUE(edited) << edited.error().message;
    EXPECT_EQ(edited->id, id);
    EXPECT_EQ(edited->revision, before + 1);
    if (nth == 1) came_[id] = edited->revision;
    EXPECT_EQ(edited->entity_revision, nth == 0 ? 0 : came_[id] + nth - 1);
    EXPECT_EQ(scene.revision(), before + 1);
  }

  // The revision of an entity's nth edit; of what `expect_edited` saw come.
  Revision nth(const char* id, Revision n) const { return came_.at(id) + n - 1; }

  Scene scene;

 private:
  std::map<std::string, Revision> came_;
};

}  // namespace posed
