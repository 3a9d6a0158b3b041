#include "server/solver/goal_report.h"

#include "server/solver/kinematics.h"

namespace posed {
namespace {

constexpr double kParallel = 1e-6;  // sine below which a target lies straight behind or before a lever

class Reporter {
 public:
  Reporter(const BodyTree& tree, const ReachTree& reach, std::span<const int> node_of_segment,
           std::span<const Transform> world)
      : tree_(tree), reach_(reach), node_of_segment_(node_of_segment), world_(world) {}

  void place(const ReachGoal& goal, GoalReport& report) const {
    report.causes.clear();
    report.causes.reserve(kMaxCauses + 1);
    report.touch = world_[static_cast<std::size_t>(goal.segment)] * goal.point;
    report.target = finite(goal.target) ? target_of(goal) : report.touch;
    report.error = glm::length(report.target - report.touch);
    const double weight = pull_of(goal);
    report.force = (report.target - report.touch) * weight;
    if (weight == 0.0) {
      report.state = GoalState::off;
    } else if (over_tolerance(goal.tolerance, report.target - report.touch, kReached) <= 1.0) {
      report.state = GoalState::reached;
    } else {
      report.state = stuck(goal, report) ? GoalState::unreachable : GoalState::balanced;
    }
  }

  // Where the chain from the parent node is straight and points at the target: how far that lies beyond its end.
  double beyond(const ReachGoal& goal, const GoalReport& report) const {
    const ReachNode& node = node_of(goal);
    if (node.parent < 0) return 0.0;
    Vec3 base{}, last{};
    double length = 0.0;
    bool any = false;
    for (int k = node.begin; k < node.chain_end; ++k) {
      const int i = reach_.order[static_cast<std::size_t>(k)];
      if (!bends_as_ball(tree_.joint(i).type)) continue;
      const Vec3& origin = world_[static_cast<std::size_t>(i)].position;
      if (any) length += glm::length(origin - last);
      if (!any) base = origin;
      last = origin;
      any = true;
    }
    if (!any) return 0.0;
    length += glm::length(report.touch - last);
    const bool straight = glm::length(report.touch - base) >= length * (1.0 - kParallel);
    return straight ? std::max(0.0, glm::length(report.target - base) - length) : 0.0;
  }

 private:
  const ReachNode& node_of(const ReachGoal& goal) const {
    const int node = node_of_segment_[static_cast<std::size_t>(goal.segment)];
    return reach_.nodes[static_cast<std::size_t>(node)];
  }

  bool stuck(const ReachGoal& goal, const GoalReport& report) const {
    if (tree_.root_is_free()) return false;
    const Vec3 wish = report.target - report.touch;
    // The chain of the root node is the body root alone, which does not bend.
    for (const ReachNode* node = &node_of(goal); node->parent >= 0;
         node = &reach_.nodes[static_cast<std::size_t>(node->parent)]) {
      for (int k = node->begin; k < node->chain_end; ++k) {
        const int i = reach_.order[static_cast<std::size_t>(k)];
        if (!bends_as_ball(tree_.joint(i).type)) continue;
        const Vec3 lever = report.touch - world_[static_cast<std::size_t>(i)].position;
        const double turning = glm::length(glm::cross(lever, wish));
        if (turning > kParallel * glm::length(lever) * glm::length(wish)) return false;
      }
    }
    return true;
  }

  const BodyTree& tree_;
  const ReachTree& reach_;
  std::span<const int> node_of_segment_;
  std::span<const Transform> world_;
};

// The goals that pull most against goal `i`.
void name_opponents(std::size_t i, std::vector<GoalReport>& out) {
  auto& causes = out[i].causes;
  const auto opposition = [&](int k) { return -glm::dot(out[i].force, out[static_cast<std::size_t>(k)].force); };
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (k == i || out[k].state == GoalState::off || !(opposition(static_cast<int>(k)) > 0.0)) continue;
    std::size_t place = causes.size();
    while (place > 0 && opposition(causes[place - 1].goal) < opposition(static_cast<int>(k))) --place;
    if (place == kMaxCauses) continue;
    if (causes.size() == kMaxCauses) causes.pop_back();
    causes.insert(causes.begin() + static_cast<std::ptrdiff_t>(place), {Cause::Kind::goal, static_cast<int>(k), 0.0});
  }
}

}  // namespace

void report_goals(const BodyTree& tree, const ReachTree& reach, std::span<const int> node_of_segment,
                  std::span<const ReachGoal> goals, std::span<const Transform> world_from_segment,
                  std::vector<GoalReport>& out) {
  const Reporter reporter(tree, reach, node_of_segment, world_from_segment);
  out.resize(goals.size());
  for (std::size_t i = 0; i < goals.size(); ++i) reporter.place(goals[i], out[i]);
  for (std::size_t i = 0; i < goals.size(); ++i) {
    if (out[i].state != GoalState::balanced && out[i].state != GoalState::unreachable) continue;
    if (out[i].state == GoalState::balanced) name_opponents(i, out);
    const double beyond = reporter.beyond(goals[i], out[i]);
    if (beyond > 0.0) out[i].causes.push_back({Cause::Kind::beyond, -1, beyond});
  }
}

}  // namespace posed
