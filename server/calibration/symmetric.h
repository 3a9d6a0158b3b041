// Eigenvalues and eigenvectors of small symmetric matrices, by Jacobi's rotations: exact to rounding at these sizes,
// and simple. Pure; does not allocate.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace posed::calibration {

template <std::size_t N>
using Matrix = std::array<std::array<double, N>, N>;

template <std::size_t N>
struct Eigen {
  std::array<double, N> values;                  // ascending
  std::array<std::array<double, N>, N> vectors;  // vectors[i] belongs to values[i], of unit length
};

template <std::size_t N>
Eigen<N> eigen(Matrix<N> a) {
  Matrix<N> v{};
  for (std::size_t i = 0; i < N; ++i) v[i][i] = 1.0;
  constexpr int kSweeps = 50;  // it converges quadratically: five or six do
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double off = 0.0, on = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
      on += a[i][i] * a[i][i];
      for (std::size_t j = i + 1; j < N; ++j) off += a[i][j] * a[i][j];
    }
    if (off <= 1e-32 * on) break;
    for (std::size_t p = 0; p < N; ++p) {
      for (std::size_t q = p + 1; q < N; ++q) {
        if (a[p][q] == 0.0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
        const double c = 1.0 / std::hypot(t, 1.0), s = t * c;
        for (std::size_t k = 0; k < N; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < N; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
          const double vp = v[p][k], vq = v[q][k];
          v[p][k] = c * vp - s * vq;
          v[q][k] = s * vp + c * vq;
        }
      }
    }
  }
  Eigen<N> out;
  std::array<std::size_t, N> order;
  for (std::size_t i = 0; i < N; ++i) order[i] = i;
  for (std::size_t i = 1; i < N; ++i) {
    for (std::size_t j = i; j > 0 && a[order[j]][order[j]] < a[order[j - 1]][order[j - 1]]; --j)
      std::swap(order[j], order[j - 1]);
  }
  for (std::size_t i = 0; i < N; ++i) {
    out.values[i] = a[order[i]][order[i]];
    out.vectors[i] = v[order[i]];
  }
  return out;
}

}  // namespace posed::calibration
