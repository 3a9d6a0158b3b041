// The paper's Figures 3 to 11 as scenes: each is balanced, and shows what its figure or its text claims.
#include <gtest/gtest.h>

#include "tests/support/figures.h"
#include "tests/support/scene_file.h"

namespace posed {
namespace {

struct Solved {
  test::SceneFile scene;
  Pose pose;

  explicit Solved(const std::string& name) : scene(test::read_template(POSED_SOURCE_DIR, name)) { solve(); }

  // From the scene's start, with the goals as they now are.
  void solve() {
    auto q = scene.start;
    ReachTreeSolver(scene.tree).solve(q, scene.goals, {}, {}, pose);
  }
  const GoalReport& operator[](const std::string& id) const {
    return pose.goals[static_cast<std::size_t>(scene.index(id))];
  }
  const Transform& segment(const char* name) const {
    return pose.world_from_segment[static_cast<std::size_t>(scene.tree->find_segment(name).value())];
  }
  Vec3 touch(const char* name) const {
    return segment(name) * scene.tree->segment(scene.tree->find_segment(name).value()).touch_point;
  }
  bool caused_by(const std::string& id, const std::string& other) const {
    for (const Cause& c : (*this)[id].causes) {
      if (c.kind == Cause::Kind::goal && c.goal == scene.index(other)) return true;
    }
    return false;
  }
};

// The sum of weight x displacement, as a share of its terms; no share of less than a micrometre a goal.
double imbalance(const Pose& pose, const std::vector<ReachGoal>& goals) {
  Vec3 sum = kZero;
  double terms = 0.0;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    sum += pose.goals[i].force;
    terms += std::max(glm::length(pose.goals[i].force), goals[i].weight * 1e-6);
  }
  return terms > 0.0 ? glm::length(sum) / terms : 0.0;
}

void expect_balanced(const Solved& s, const std::string& what) {
  EXPECT_EQ(s.pose.report.status, SolveStatus::converged) << what;
  EXPECT_LT(imbalance(s.pose, s.scene.goals), 1e-6) << what;
  EXPECT_LT(s.pose.report.balance_error, 1e-6) << what;
  EXPECT_LT(test::worst_bone(*s.scene.tree, s.pose.world_from_segment), 1e-9) << what;
  EXPECT_LT(test::worst_quaternion(*s.scene.tree, s.pose.q), 1e-12) << what;
  EXPECT_TRUE(test::all_finite(s.pose)) << what;
}

const char* const kScenes[] = {"empty",           "paper/single-reach", "paper/two-reaches", "paper/unreachable",
                               "paper/sitting",   "paper/restrained",   "paper/seat-belt",   "paper/two-hands",
                               "paper/straighten"};

class Scene : public testing::TestWithParam<const char*> {};

TEST_P(Scene, IsBalanced) {
  expect_balanced(Solved(GetParam()), GetParam());
}

TEST_P(Scene, IsTheSameEveryTime) {
  const Solved a(GetParam()), b(GetParam());
  EXPECT_TRUE(test::same_bytes(a.pose.q, b.pose.q));
}

TEST_P(Scene, TakesNoMoreThanItTook) {
  const Solved s(GetParam());
  EXPECT_LE(s.pose.report.iterations, 200);
  EXPECT_LE(s.pose.report.chain_solves, 1600);
}

INSTANTIATE_TEST_SUITE_P(Each, Scene, testing::ValuesIn(kScenes));

TEST(PaperScenes, Figure4SingleReach) {
  const Solved s("paper/single-reach");
  EXPECT_EQ(s["right_hand"].state, GoalState::reached);
  EXPECT_EQ(s["pelvis"].state, GoalState::reached);
  EXPECT_NEAR(s.touch("upper_torso").x, 0.0, 1e-9);  // within the arm's reach, so the trunk is not moved
}

TEST(PaperScenes, Figure5TwoReachableGoals) {
  const Solved s("paper/two-reaches");
  EXPECT_EQ(s["right_hand"].state, GoalState::reached);
  EXPECT_EQ(s["left_hand"].state, GoalState::reached);
  EXPECT_EQ(s["pelvis"].state, GoalState::reached);
}

TEST(PaperScenes, Figure7DistancesGoAsOneToFour) {
  const Solved s("paper/unreachable");
  EXPECT_EQ(s["right_hand"].state, GoalState::balanced);
  EXPECT_EQ(s["right_upper_arm"].state, GoalState::balanced);
  EXPECT_GT(s["right_hand"].error, 0.05);
  EXPECT_NEAR(s["right_upper_arm"].error / s["right_hand"].error, 4.0, 0.02);
  EXPECT_TRUE(s.caused_by("right_hand", "right_upper_arm"));
  EXPECT_TRUE(s.caused_by("right_upper_arm", "right_hand"));
}

TEST(PaperScenes, Figure9LooksLikeSitting) {
  const Solved s("paper/sitting");
  // "much higher than the others summed together": the lower torso stays where it was put.
  EXPECT_LT(s["lower_torso"].error, 0.08);
  for (const std::string side : {"left", "right"}) {
    const Vec3 hip = s.segment((side + "_upper_leg").c_str()).position;
    const Vec3 knee = s.touch((side + "_upper_leg").c_str());
    const Vec3 ankle = s.touch((side + "_lower_leg").c_str());
    EXPECT_LT(std::abs(knee.z - hip.z), 0.05);  // thighs parallel to the seat
    EXPECT_GT(knee.x - hip.x, 0.35);
    EXPECT_GT(knee.z - ankle.z, 0.40);  // shanks down
    EXPECT_LT(std::abs(ankle.x - knee.x), 0.15);
    EXPECT_EQ(s[side + "_knee"].state, GoalState::balanced);
  }
  const Vec3 back = s.touch("upper_torso") - s.segment("upper_torso").position;
  EXPECT_GT(back.z, 0.9 * glm::length(back));  // upright, leaning against the back of the chair
  EXPECT_LT(back.x, 0.0);
}

TEST(PaperScenes, Figure10TheTorsoGivesWayByATenth) {
  const Solved s("paper/restrained");
  EXPECT_NEAR(s["lower_torso"].error / s["right_hand"].error, 0.1, 1e-6);
  EXPECT_GT(s["right_hand"].error, 0.05);
  ASSERT_FALSE(s["right_hand"].causes.empty());
  EXPECT_EQ(s["right_hand"].causes.back().kind, Cause::Kind::beyond);
  EXPECT_NEAR(s["right_hand"].causes.back().beyond_m, s["right_hand"].error, 1e-6);
}

TEST(PaperScenes, Figure11TheBeltHolds) {
  Solved s("paper/seat-belt");
  EXPECT_LT(s["lower_torso"].error, 0.02);
  EXPECT_LT(s["left_shoulder"].error, 0.02);
  EXPECT_EQ(s["right_hand"].state, GoalState::balanced);
  const double with_belt = s["right_hand"].error;
  EXPECT_GT(with_belt, 0.05);

  s.scene.goal("left_shoulder").enabled = false;
  s.solve();
  expect_balanced(s, "without the shoulder strap");
  EXPECT_LT(s["right_hand"].error, with_belt);
}

TEST(PaperScenes, TwoHandsStayTogetherWhileOtherGoalsMove) {
  Solved s("paper/two-hands");
  EXPECT_EQ(s["left_hand"].state, GoalState::reached);
  EXPECT_EQ(s["right_hand"].state, GoalState::reached);
  const Vec3 torso = s.scene.goal("lower_torso").target, foot = s.scene.goal("right_foot").target;
  for (int n = 0; n < 48; ++n) {
    const double angle = 2.0 * M_PI * n / 48.0;
    s.scene.goal("lower_torso").target =
        torso + Vec3(0.15 * std::cos(angle), 0.15 * std::sin(angle), 0.1 * std::sin(3 * angle));
    s.scene.goal("right_foot").target = foot + Vec3(0.3 * std::sin(angle), 0.0, 0.2 + 0.2 * std::cos(angle));
    s.solve();
    EXPECT_LT(glm::length(s["left_hand"].touch - s["right_hand"].touch), 0.01) << n;
    s.scene.start = s.pose.q;  // as a viewer that drags
  }
}

TEST(PaperScenes, PulledAnklesStraightenTheBody) {
  Solved s("paper/straighten");
  const double pulled = s.scene.goal("left_ankle").target.z;
  double longest = 0.0;
  for (int n = 0; n <= 10; ++n) {
    for (const char* id : {"left_ankle", "right_ankle"}) s.scene.goal(id).target.z = 0.6 + (pulled - 0.6) * n / 10.0;
    s.solve();
    expect_balanced(s, "pulled");
    const double length = s.touch("left_hand").z - s.touch("left_lower_leg").z;
    EXPECT_GT(length, longest - 1e-6) << n;
    longest = length;
  }
  EXPECT_LT(glm::length(s["left_hand"].touch - s["right_hand"].touch), 0.02);
  for (const std::string side : {"left", "right"}) {
    const auto name = [&](const char* part) { return side + "_" + part; };
    const Vec3 shoulder = s.segment(name("upper_arm").c_str()).position,
               hip = s.segment(name("upper_leg").c_str()).position;
    EXPECT_NEAR(glm::length(s.touch(name("hand").c_str()) - shoulder), (0.186 + 0.146 + 0.054) * 1.75, 1e-6);
    EXPECT_NEAR(glm::length(s.touch(name("lower_leg").c_str()) - hip), (0.245 + 0.246) * 1.75, 1e-6);
    EXPECT_TRUE(s[name("ankle")].causes.back().kind == Cause::Kind::beyond);
  }
  const Vec3 trunk = s.touch("upper_torso") - s.segment("lower_torso").position;
  EXPECT_GT(trunk.z, 0.999 * glm::length(trunk));
}

}  // namespace
}  // namespace posed
