// Simbody's Assembler with markers and limits, from one start: balls are its gimbals, so that each hinge is one of its
// q.
#include "tests/bench/solver/simbody_rig.h"

#include <algorithm>

#include "tests/bench/solver/contestant.h"

namespace posed::test {
namespace {

void copy(const Vec3& v, double* out) {
  std::copy_n(&v.x, 3, out);
}

std::vector<SimbodyBody> bodies_of(const HingeFigure& figure) {
  std::vector<SimbodyBody> bodies;
  for (const Part& part : figure.parts()) {
    SimbodyBody& body = bodies.emplace_back();
    body.parent = part.parent;
    body.hinges = part.hinges;
    copy(part.parent_from_joint.position, body.position);
    const Quat& turn = part.parent_from_joint.rotation;
    const double wxyz[] = {turn.w, turn.x, turn.y, turn.z};
    std::copy_n(wxyz, 4, body.quat_wxyz);
    for (int k = 0; k < part.hinges; ++k) {
      const Hinge& hinge = figure.hinges()[static_cast<std::size_t>(part.first_hinge + k)];
      if (k < 2) copy(hinge.axis, body.axes[k]);
      body.min[k] = hinge.min, body.max[k] = hinge.max;
    }
  }
  return bodies;
}

std::vector<SimbodyMarker> markers_of(const Problem& problem) {
  std::vector<SimbodyMarker> markers;
  for (const PointGoal& goal : problem) {
    SimbodyMarker& marker = markers.emplace_back();
    marker.body = goal.at.segment;
    copy(goal.at.point, marker.point);
    marker.weight = goal.weight;
  }
  return markers;
}

class SimbodyPeer final : public Contestant {
 public:
  explicit SimbodyPeer(const HingeFigure& figure) : bodies_(bodies_of(figure)) {}

  std::string who() const override { return "simbody"; }
  bool slow() const override { return true; }

  void prepare(const Problem& problem, std::span<const double> start, bool) override {
    if (!same_points(problem, rig_for_)) {
      rig_ = std::make_unique<SimbodyRig>(bodies_, markers_of(problem));
      rig_for_ = problem;
    }
    for (std::size_t g = 0; g < problem.size(); ++g) rig_->aim(static_cast<int>(g), &problem[g].target.x);
    rig_->start_at(start.data());
  }
  void solve() override { rig_->solve(); }
  void answer(std::span<double> x) const override { rig_->answer(x.data()); }

 private:
  std::vector<SimbodyBody> bodies_;
  Problem rig_for_;
  std::unique_ptr<SimbodyRig> rig_;
};

}  // namespace

std::unique_ptr<Contestant> simbody_peer(const HingeFigure& figure) {
  return std::make_unique<SimbodyPeer>(figure);
}

}  // namespace posed::test
