// What Eigen's general routines are slow at for matrices of 3 to 24 rows whose size the compiler knows: all loops are
// of constant length, over whole columns, so that they become a few wide instructions.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstring>
#include <utility>

namespace posed::test {

// Four numbers that the compiler keeps in a register.
using Four [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;

// The lower triangle of gram = a a^T, in panels of four columns whose sums stay in registers; what is above it is not
// set.
template <int First, class Matrix, class Gram>
void gram_panel(const Matrix& a, Gram& gram) {
  constexpr int kRows = Matrix::RowsAtCompileTime, kColumns = Matrix::ColsAtCompileTime, kFours = (kRows - First) / 4;
  Four sum[4][kFours] = {};
  for (int k = 0; k < kColumns; ++k) {
    const double* const column = a.data() + k * kRows + First;
    const auto* const fours = reinterpret_cast<const Four*>(column);
#pragma GCC unroll 8
    for (int i = 0; i < kFours; ++i) {
      const Four four = fours[i];
#pragma GCC unroll 4
      for (int j = 0; j < 4; ++j) sum[j][i] += column[j] * four;
    }
  }
  for (int j = 0; j < 4; ++j) std::memcpy(gram.data() + (First + j) * kRows + First, sum[j], sizeof sum[j]);
}

template <class Matrix, class Gram>
void lower_gram(const Matrix& a, Gram& gram) {
  constexpr int kRows = Matrix::RowsAtCompileTime;
  if constexpr (kRows % 4 == 0) {
    [&]<int... panel>(std::integer_sequence<int, panel...>) {
      (gram_panel<4 * panel>(a, gram), ...);
    }
    (std::make_integer_sequence<int, kRows / 4>());
  } else {
    gram.noalias() = a.lazyProduct(a.transpose());
  }
}

// Cholesky of a symmetric positive definite `a` (its lower triangle) in place, and x = a^-1 x.
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
