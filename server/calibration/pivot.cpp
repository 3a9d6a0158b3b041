#include "server/calibration/pivot.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "server/calibration/symmetric.h"

namespace posed::calibration {
namespace {

using Mat3 = glm::dmat3;

constexpr std::size_t kLeastPoses = 10;
constexpr double kLeastSwing = 0.01;  // least eigenvalue of 1 - R̄ᵀR̄: the stylus was turned by some six degrees, rms

}  // namespace

// R_i t + p_i = c for all i. The pivot c that fits best is the mean of the left side; what is left of t is three normal
// equations, (1 - R̄ᵀR̄) t = R̄ᵀ p̄ - mean(R_iᵀ p_i).
Result<TipOffset> fit_pivot(std::span<const Transform> poses) {
  if (poses.size() < kLeastPoses)
    return Error{"invalid_params", "the sensor was heard too seldom to find its tip", "/for_ms",
                 "swing it for some seconds"};
  const auto n = static_cast<double>(poses.size());
  Mat3 mean_r(0.0);
  Vec3 mean_p = kZero, mean_rp = kZero;
  for (const Transform& pose : poses) {
    mean_r += glm::mat3_cast(pose.rotation) / n;
    mean_p += pose.position / n;
    mean_rp += glm::conjugate(pose.rotation) * pose.position / n;
  }
  const Mat3 normal = Mat3(1.0) - glm::transpose(mean_r) * mean_r;
  Matrix<3> symmetric;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) symmetric[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = normal[i][j];
  }
  const Eigen<3> axes = eigen(symmetric);
  if (axes.values[0] < kLeastSwing)
    return Error{"invalid_params", "the stylus was hardly turned, or about one axis only: its tip can't be told", "",
                 "hold the tip in one place and swing the other end in wide circles, turning it too"};
  TipOffset tip;
  const Vec3 right = glm::transpose(mean_r) * mean_p - mean_rp;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 axis(axes.vectors[i][0], axes.vectors[i][1], axes.vectors[i][2]);
    tip.offset += axis * (glm::dot(axis, right) / axes.values[i]);
  }
  const Vec3 pivot = mean_r * tip.offset + mean_p;
  double sum = 0.0;
  for (const Transform& pose : poses) {
    const Vec3 off = pose * tip.offset - pivot;
    sum += glm::dot(off, off);
  }
  tip.residual_m = std::sqrt(sum / n);
  tip.samples = static_cast<int>(poses.size());
  return tip;
}

}  // namespace posed::calibration
