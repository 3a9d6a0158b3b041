// Ceres with an analytic Jacobian and the hinges' ranges as bounds, from one start.
#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>

#include "tests/bench/solver/contestant.h"

namespace posed::test {
namespace {

// The residuals sqrt(weight) (point - target) of all goals against the root's position, its quaternion and the hinges.
class GoalCost final : public ceres::CostFunction {
 public:
  GoalCost(const HingeFigure& figure, const Problem& problem) : figure_(figure), problem_(problem) {
    set_num_residuals(3 * static_cast<int>(problem.size()));
    *mutable_parameter_block_sizes() = {3, 4, kHinges};
    x_.resize(static_cast<std::size_t>(figure.size()));
  }

  bool Evaluate(double const* const* values, double* residuals, double** jacobians) const override {
    std::copy_n(values[0], 3, x_.begin());
    std::copy_n(values[1], 4, x_.begin() + 3);
    std::copy_n(values[2], kHinges, x_.begin() + kRootSize);
    figure_.place(x_, placement_);
    for (std::size_t g = 0; g < problem_.size(); ++g) {
      const PointGoal& goal = problem_[g];
      const double scale = std::sqrt(goal.weight);
      const Vec3 point = placement_.world_from_part[static_cast<std::size_t>(goal.at.segment)] * goal.at.point;
      const Vec3 miss = scale * (point - goal.target);
      std::copy_n(&miss.x, 3, residuals + 3 * g);
      if (jacobians) fill(goal.at.segment, point, scale, 3 * g, jacobians);
    }
    return true;
  }

 private:
  // Row-major blocks. The quaternion's is given in its four numbers, though it moves in three directions only: with
  // Ceres's q(d) = (d, 1) q, whose derivatives are the columns E, a small d turns by 2 d, so the block is 2 R E^T.
  void fill(int segment, const Vec3& point, double scale, std::size_t row, double** jacobians) const {
    const auto write = [&](double* block, int columns, int column, const Vec3& v) {
      for (int k = 0; k < 3; ++k) block[(row + static_cast<std::size_t>(k)) * columns + column] = scale * v[k];
    };
    if (jacobians[0]) write(jacobians[0], 3, 0, kX), write(jacobians[0], 3, 1, kY), write(jacobians[0], 3, 2, kZ);
    if (jacobians[1]) {
      const Vec3 arm = point - Vec3(x_[0], x_[1], x_[2]);
      const double x = x_[3], y = x_[4], z = x_[5], w = x_[6];
      const Vec3 rows[4] = {{w, z, -y}, {-z, w, x}, {y, -x, w}, {-x, -y, -z}};  // E
      for (int k = 0; k < 4; ++k) write(jacobians[1], 4, k, 2.0 * glm::cross(rows[k], arm));
    }
    if (!jacobians[2]) return;
    for (std::size_t k = 0; k < 3; ++k) std::fill_n(jacobians[2] + (row + k) * kHinges, kHinges, 0.0);
    for (const int h : figure_.hinges_above(segment)) {
      const auto part = static_cast<std::size_t>(figure_.hinges()[static_cast<std::size_t>(h)].part);
      const Vec3 arm = point - placement_.world_from_part[part].position;
      write(jacobians[2], kHinges, h, glm::cross(placement_.axis[static_cast<std::size_t>(h)], arm));
    }
  }

  const HingeFigure& figure_;
  const Problem& problem_;
  mutable std::vector<double> x_;
  mutable Placement placement_;
};

class CeresPeer final : public Contestant {
 public:
  explicit CeresPeer(const HingeFigure& figure) : figure_(figure), x_(figure.start()) {
    options_.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;  // quicker than DENSE_QR here
    options_.num_threads = 1;
    options_.logging_type = ceres::SILENT;
    FLAGS_minloglevel = google::GLOG_FATAL;
    options_.use_nonmonotonic_steps = true;  // solves twice as many of set c
    options_.max_num_iterations = 200;
    options_.function_tolerance = 1e-6;
    options_.callbacks.push_back(&enough_);
  }

  std::string who() const override { return "ceres"; }

  void prepare(const Problem& problem, std::span<const double> start, bool) override {
    x_.assign(start.begin(), start.end());
    task_ = std::make_unique<ceres::Problem>();
    double* const root = x_.data();
    double* const hinges = root + kRootSize;
    task_->AddParameterBlock(root + 3, 4, new ceres::EigenQuaternionManifold);
    task_->AddResidualBlock(new GoalCost(figure_, problem), nullptr, root, root + 3, hinges);
    double weights = 0.0;
    for (const PointGoal& goal : problem) weights += goal.weight;
    enough_.cost = 0.5 * weights * kAskedRms * kAskedRms;
    for (int h = 0; h < kHinges; ++h) {
      const Hinge& hinge = figure_.hinges()[static_cast<std::size_t>(h)];
      if (!hinge.limited()) continue;
      task_->SetParameterLowerBound(hinges, h, hinge.min);
      task_->SetParameterUpperBound(hinges, h, hinge.max);
    }
  }
  void solve() override { ceres::Solve(options_, task_.get(), &summary_); }
  void answer(std::span<double> x) const override {
    std::copy(x_.begin(), x_.end(), x.begin());
    const auto turn = xyzw(glm::normalize(root_turn(x_)));
    std::copy(turn.begin(), turn.end(), x.begin() + 3);
  }

 private:
  struct Enough final : ceres::IterationCallback {
    double cost = 0.0;
    ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
      return summary.cost <= cost ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }
  };

  const HingeFigure& figure_;
  std::vector<double> x_;
  Enough enough_;
  ceres::Solver::Options options_;
  ceres::Solver::Summary summary_;
  std::unique_ptr<ceres::Problem> task_;
};

}  // namespace

std::unique_ptr<Contestant> ceres_peer(const HingeFigure& figure) {
  return std::make_unique<CeresPeer>(figure);
}

}  // namespace posed::test
