// Several editors on one scene.
#pragma once

#include <string>

#include "server/scene/editing.h"
#include "tests/server/scene/scene_fixture.h"

namespace posed {

class EditingTest : public SceneTest {
 protected:
  EditBy by(const std::string& name, const std::string& gesture = "") {
    EditBy who;
    who.editor = {name, name, name};
    who.owner = std::hash<std::string>{}(name);
    who.t_ns = now;
    who.method = "goal.set";
    who.gesture = gesture;
    return who;
  }
  Result<Edited> set(const EditBy& who, const std::string& id, Vec3 position) {
    return editing.edit(who, [&](Scene& s) { return s.set_goal(goal_edit(id, "right_hand", position), {}); });
  }
  template <class F>
  Result<Edited> edit(const EditBy& who, F change) {
    return editing.edit(who, [&](Scene& s) -> Result<Edited> { return change(s); });
  }
  // An edit of a figure's pose.
  Result<Edited> move(const EditBy& who, double x, const std::string& figure = "body") {
    std::vector<double> q = scene.figures().at(figure).q;
    q[0] = x;
    return edit(who, [&](Scene& s) { return s.set_q(figure, q, {}); });
  }
  std::string document() const { return proto::encode_scene(scene.document()); }
  void solved(double x) {  // as if the solver had moved the figure
    std::vector<double> q = scene.figures().at("body").q;
    q[0] = x;
    scene.settle("body", q);
  }
  double pose() const { return scene.figures().at("body").q[0]; }
  // The last step, undone, leaves `before`; done again, what stands now.
  void expect_back_and_forth(const EditBy& who, const std::string& before) {
    const std::string after = document();
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(editing.undo(who));
      EXPECT_EQ(document(), before);
      const Result<Done> again = editing.redo(who);
      ASSERT_TRUE(again) << again.error().message;
      EXPECT_EQ(document(), after);
    }
  }

  Editing editing{scene};
  Nanoseconds now = 0;
};

}  // namespace posed
