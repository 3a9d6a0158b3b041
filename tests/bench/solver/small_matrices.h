// What Eigen's general routines are slow at for matrices of 3 to 24 rows whose size the compiler knows: all loops are of
// constant length, over whole columns, so that they become a few wide instructions.
#pragma once

#include <Eigen/Core>

namespace posed::test {

// gram = a a^T. Panels of four columns stay in registers.
template <class Matrix, class Gram>
void gram_of(const Matrix& a, Gram& gram) {
  constexpr int kRows = Matrix::RowsAtCompileTime, kColumns = Matrix::ColsAtCompileTime;
  constexpr int kPanel = kRows % 4 == 0 ? 4 : kRows;
  const double* const from = a.data();
  for (int first = 0; first < kRows; first += kPanel) {
    double sum[kPanel][kRows] = {};
    for (int k = 0; k < kColumns; ++k) {
      const double* const column = from + k * kRows;
#pragma GCC unroll 8
      for (int j = 0; j < kPanel; ++j) {
        const double factor = column[first + j];
#pragma GCC unroll 24
        for (int i = 0; i < kRows; ++i) sum[j][i] += factor * column[i];
      }
    }
    for (int j = 0; j < kPanel; ++j) {
      for (int i = 0; i < kRows; ++i) gram(i, first + j) = sum[j][i];
    }
  }
}

// Cholesky of a symmetric positive definite `a` in place, and x = a^-1 x.
template <class Gram, class Rows>
void factor_and_solve(Gram& a, Rows& x) {
  constexpr int kRows = Gram::RowsAtCompileTime;
  Rows inverse;  // of the factor's diagonal
  for (int j = 0; j < kRows; ++j) {
    Rows column = a.col(j);
    for (int k = 0; k < j; ++k) column -= a(j, k) * a.col(k);
    inverse[j] = 1.0 / std::sqrt(column[j]);
    for (int i = 0; i < j; ++i) column[i] = 0.0;  // what lies above the diagonal takes part in whole columns
    a.col(j) = inverse[j] * column;
    x[j] *= inverse[j];
    const double known = x[j];
    x -= known * a.col(j);
    x[j] = known;
  }
  Rows solution = Rows::Zero();
  for (int j = kRows - 1; j >= 0; --j) solution[j] = inverse[j] * (x[j] - a.col(j).dot(solution));
  x = solution;
}

}  // namespace posed::test
