// Orocos KDL's solver for trees, TreeIkSolverPos_Online over weighted damped least squares, called until it is there or
// gets no nearer. KDL has no free base: three prismatic and three revolute joints stand for it.
#include <algorithm>
#include <cmath>
#include <kdl/tree.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl/treeiksolverpos_online.hpp>
#include <kdl/treeiksolvervel_wdls.hpp>
#include <map>

#include "tests/bench/solver/contestant.h"

namespace posed::test {
namespace {

constexpr int kRootJoints = 6;
constexpr double kFar = 1e3;  // where a number is wanted for what is not limited

KDL::Vector vector(const Vec3& v) {
  return {v.x, v.y, v.z};
}
KDL::Frame frame(const Transform& t) {
  return {KDL::Rotation::Quaternion(t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w), vector(t.position)};
}
std::string end_name(std::size_t g) {
  return "end" + std::to_string(g);
}

// The tree of one set of points, with the solvers on it.
class Rig {
 public:
  Rig(const HingeFigure& figure, const Problem& problem) : figure_(figure), tree_("world") {
    add_root();
    for (std::size_t i = 1; i < figure.parts().size(); ++i) add_part(static_cast<int>(i));
    // A KDL segment's frame is at its tip: each hinge's is the frame after its turn.
    for (std::size_t g = 0; g < problem.size(); ++g) {
      ends_.push_back(end_name(g));
      tree_.addSegment(
          KDL::Segment(ends_.back(), KDL::Joint(KDL::Joint::None), KDL::Frame(vector(problem[g].at.point))),
          tip_[static_cast<std::size_t>(problem[g].at.segment)]);
    }
    const auto joints = tree_.getNrOfJoints();
    KDL::JntArray low(joints), high(joints), fastest(joints);
    for (unsigned k = 0; k < joints; ++k) low(k) = -kFar, high(k) = kFar, fastest(k) = kFar;
    for (std::size_t h = 0; h < figure.hinges().size(); ++h) {
      const Hinge& hinge = figure.hinges()[h];
      if (hinge.limited()) low(joint_of(hinge_name(h))) = hinge.min, high(joint_of(hinge_name(h))) = hinge.max;
    }
    forward_ = std::make_unique<KDL::TreeFkSolverPos_recursive>(tree_);
    velocity_ = std::make_unique<KDL::TreeIkSolverVel_wdls>(tree_, ends_);
    velocity_->setWeightTS(weights(problem));
    velocity_->setLambda(kDamping);
    position_ = std::make_unique<KDL::TreeIkSolverPos_Online>(joints, ends_, low, high, fastest, kFar, kFar, *forward_,
                                                              *velocity_);
    q_.resize(joints), next_.resize(joints), best_.resize(joints);
  }

  void start_at(std::span<const double> x) {
    for (unsigned k = 0; k < 3; ++k) q_(k) = x[k];
    KDL::Rotation::Quaternion(x[3], x[4], x[5], x[6]).GetRPY(q_(5), q_(4), q_(3));  // Rz Ry Rx
    for (std::size_t h = 0; h < kHinges; ++h) q_(joint_of(hinge_name(h))) = x[kRootSize + h];
  }

  void aim(const Problem& problem) {
    double weights = 0.0;
    for (std::size_t g = 0; g < problem.size(); ++g) {
      targets_[ends_[g]] = KDL::Frame(vector(problem[g].target));
      weights += problem[g].weight;
    }
    enough_ = kAskedRms * std::sqrt(weights);
  }

  // The error that a call returns is that of the joints it was given.
  void solve() {
    double least = INFINITY, mark = INFINITY;
    for (int n = 0; n < kMostCalls; ++n) {
      const double error = position_->CartToJnt(q_, targets_, next_);
      if (error < 0.0) break;
      if (error < least) least = error, best_ = q_;
      if (least <= enough_) break;
      if (n % kWindow == kWindow - 1) {
        if (least > 0.99 * mark) break;
        mark = least;
      }
      std::swap(q_, next_);
    }
  }

  void answer(std::span<double> x) const {
    for (unsigned k = 0; k < 3; ++k) x[k] = best_(k);
    KDL::Rotation::RPY(best_(5), best_(4), best_(3)).GetQuaternion(x[3], x[4], x[5], x[6]);
    for (std::size_t h = 0; h < kHinges; ++h) x[kRootSize + h] = best_(joint_of(hinge_name(h)));
  }

 private:
  static constexpr double kDamping = 0.03;
  static constexpr int kMostCalls = 300, kWindow = 20;

  static std::string hinge_name(std::size_t h) { return "hinge" + std::to_string(h); }

  unsigned joint_of(const std::string& segment) const { return tree_.getSegment(segment)->second.q_nr; }

  void add_root() {
    using KDL::Joint;
    std::string parent = "world";
    for (const auto type : {Joint::TransX, Joint::TransY, Joint::TransZ, Joint::RotZ, Joint::RotY, Joint::RotX}) {
      const std::string name = "root" + std::to_string(tree_.getNrOfJoints());
      tree_.addSegment(KDL::Segment(name, Joint(type)), parent);
      parent = name;
    }
    tip_.push_back(parent);
  }

  void add_part(int i) {
    const Part& part = figure_.parts()[static_cast<std::size_t>(i)];
    std::string parent = figure_.parts()[static_cast<std::size_t>(i)].name;
    tree_.addSegment(KDL::Segment(parent, KDL::Joint(KDL::Joint::None), frame(part.parent_from_joint)),
                     tip_[static_cast<std::size_t>(part.parent)]);
    for (int h = part.first_hinge; h < part.first_hinge + part.hinges; ++h) {
      const KDL::Vector axis = vector(figure_.hinges()[static_cast<std::size_t>(h)].axis);
      const std::string name = hinge_name(static_cast<std::size_t>(h));
      tree_.addSegment(KDL::Segment(name, KDL::Joint(name, KDL::Vector::Zero(), axis, KDL::Joint::RotAxis)), parent);
      parent = name;
    }
    tip_.push_back(parent);
  }

  // Six rows an end, in the order of their names; where it is pointed at does not count.
  Eigen::MatrixXd weights(const Problem& problem) const {
    std::map<std::string, double> of_end;
    for (std::size_t g = 0; g < problem.size(); ++g) of_end[ends_[g]] = std::sqrt(problem[g].weight);
    const auto rows = static_cast<Eigen::Index>(6 * problem.size());
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows, rows);
    Eigen::Index row = 0;
    for (const auto& [name, weight] : of_end) {
      for (Eigen::Index k = 0; k < 3; ++k) all(row + k, row + k) = weight;
      row += 6;
    }
    return all;
  }

  const HingeFigure& figure_;
  KDL::Tree tree_;
  std::vector<std::string> ends_, tip_;  // of each goal; of each part
  std::unique_ptr<KDL::TreeFkSolverPos_recursive> forward_;
  std::unique_ptr<KDL::TreeIkSolverVel_wdls> velocity_;
  std::unique_ptr<KDL::TreeIkSolverPos_Online> position_;
  KDL::JntArray q_, next_, best_;
  KDL::Frames targets_;
  double enough_ = 0.0;
};

class KdlPeer final : public Contestant {
 public:
  explicit KdlPeer(const HingeFigure& figure) : figure_(figure) {}

  std::string who() const override { return "kdl"; }
  bool slow() const override { return true; }

  void prepare(const Problem& problem, std::span<const double> start, bool) override {
    if (!same_points(problem, rig_for_)) rig_ = std::make_unique<Rig>(figure_, problem), rig_for_ = problem;
    rig_->aim(problem);
    rig_->start_at(start);
  }
  void solve() override { rig_->solve(); }
  void answer(std::span<double> x) const override { rig_->answer(x); }

 private:
  const HingeFigure& figure_;
  Problem rig_for_;
  std::unique_ptr<Rig> rig_;
};

}  // namespace

std::unique_ptr<Contestant> kdl_peer(const HingeFigure& figure) {
  return std::make_unique<KdlPeer>(figure);
}

}  // namespace posed::test
