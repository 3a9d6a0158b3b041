#include "server/calibration/measure.h"

#include "server/calibration/symmetric.h"

namespace posed::calibration {

Still average(std::span<const Transform> poses) {
  const auto n = static_cast<double>(poses.size());
  Still still;
  Matrix<4> m{};
  for (const Transform& pose : poses) {
    still.mean.position += pose.position / n;
    const std::array<double, 4> q{pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) m[i][j] += q[i] * q[j];
    }
  }
  const auto q = eigen(m).vectors[3];
  still.mean.rotation = same_sign(poses.front().rotation, glm::normalize(Quat(q[0], q[1], q[2], q[3])));
  double sum = 0.0;
  for (const Transform& pose : poses) {
    const Vec3 off = pose.position - still.mean.position;
    sum += glm::dot(off, off);
  }
  still.spread_m = std::sqrt(sum / n);
  return still;
}

}  // namespace posed::calibration
