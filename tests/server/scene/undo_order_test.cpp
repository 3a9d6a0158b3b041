// Undo in whatever order: a model of several editors who do, undo and redo at random.
#include <algorithm>
#include <random>

#include "tests/server/scene/editing_fixture.h"

namespace posed {
namespace {

using UndoOrder = EditingTest;

// Whatever three do in whatever order: somebody can always take back their last step, until all is as it began.
TEST_F(UndoOrder, EverythingTakenBackIsTheBeginning) {
  for (unsigned seed = 1; seed <= 80; ++seed) {
    std::mt19937 random{seed};
    scene = Scene();
    ASSERT_TRUE(scene.set_figure(tempus_entry("body"), {}));
    Editing own{scene};
    const std::string before = proto::encode_scene(scene.document());
    const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const std::vector<std::string> names{"ana", "ben", "cyn"};
    const auto change = [&](Scene& s) -> Result<Edited> {
      const std::string goal = "g" + std::to_string(pick(4)), object = "o" + std::to_string(pick(2));
      const std::string figure = pick(2) ? "body" : "other", binding = "b" + std::to_string(pick(2));
      switch (pick(13)) {
        case 0:
          return s.remove_goal(goal, {});
        case 1:
          return s.set_object({object, Vec3(pick(9), 0, 0), {}, {}, {}, {}}, {});
        case 2:
          return s.remove_object(object, {});
        case 3: {
          GoalEdit edit = goal_edit(goal, "head");
          edit.relative_to = GoalBase{GoalBase::Kind::object, "", "", "", object};
          return s.set_goal(edit, {});
        }
        case 4:
          return s.set_binding(binding_edit(binding, goal), {});
        case 5:
          return s.remove_binding(binding, {});
        case 6:
          return s.set_figure(tempus_entry(figure, 1.5 + 0.1 * pick(4)), {});
        case 7:
          return pick(3) ? s.set_figure(small_entry("other"), {}) : s.remove_figure("other", {});
        case 8: {
          const auto found = s.figures().find(figure);
          if (found == s.figures().end()) return Error{};
          std::vector<double> q = found->second.tree->rest();
          if (q.size() > 7) q[0] = pick(9);
          return s.set_q(figure, q, {});
        }
        case 9: {
          if (pick(2)) return s.pin("body", pick(2) ? "head" : "left_foot", Pin::Hold::position, {});
          return s.pin("other", "tip", pick(2) ? std::optional(Pin::Hold::pose) : std::nullopt, {});
        }
        case 10: {
          GoalEdit edit = goal_edit(goal, pick(2) ? "tip" : "right_hand");
          edit.figure = "other";
          return s.set_goal(edit, {});
        }
        default: {
          const std::string hand = pick(2) ? "right_hand" : "left_hand";
          const Vec3 place(pick(9) * 0.1, 0, 1);
          return s.set_goal(goal_edit(goal, hand, place), {});
        }
      }
    };
    for (int i = 0; i < 250; ++i) {
      // One after the other: in what order arguments are drawn is the compiler's choice, and the seed would say
      // nothing.
      const std::string& name = names[static_cast<std::size_t>(pick(3))];
      const std::string gesture = pick(3) ? "" : "g" + std::to_string(pick(2));
      const EditBy who = by(name, gesture);
      (void)own.edit(who, [&](Scene& s) -> Result<Edited> {
        Result<Edited> result = change(s);
        for (int more = pick(4) ? 0 : pick(4); result && more > 0; --more) result = change(s);
        return result;
      });
      if (pick(4) == 0) {
        const std::string standing = proto::encode_scene(scene.document());
        if (own.undo(who) && pick(2) == 0) {
          const auto again = own.redo(who);
          ASSERT_TRUE(again) << again.error().message << ", seed " << seed;
          ASSERT_EQ(proto::encode_scene(scene.document()), standing) << "seed " << seed;
        }
      }
      if (pick(8) == 0 && !own.history().steps().empty()) {
        const std::size_t any = random() % own.history().steps().size();
        (void)own.undo(who, own.history().steps()[any].number);
      }
      if (pick(6) == 0) (void)own.redo(who);
      const auto above = [&](const auto& entities) {
        return std::any_of(entities.begin(), entities.end(),
                           [&](const auto& entry) { return entry.second.revision > scene.revision(); });
      };
      ASSERT_FALSE(above(scene.figures()) || above(scene.goals()) || above(scene.objects()) || above(scene.bindings()))
          << "an entity's revision is above the scene's, seed " << seed << ", edit " << i;
    }
    for (bool moved = true; moved;) {
      moved = false;
      for (const std::string& name : names) {
        while (own.undo(by(name))) moved = true;
      }
    }
    for (const std::string& name : names) {
      const auto stuck = own.undo(by(name));
      ASSERT_EQ(stuck.error().code, "nothing_to_undo") << name << ": " << stuck.error().message << ", seed " << seed;
    }
    ASSERT_EQ(proto::encode_scene(scene.document()), before) << seed;
  }
}

}  // namespace
}  // namespace posed
