#include <seiche/backend/krylov/balance.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

double off_diagonal_sum(const SparseMatrix& A, Index column, const Vector& weights) {
  double sum = 0;
  for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry)
    if (entry.row() != column) sum += std::abs(entry.value()) * weights[entry.row()];
  return sum;
}

}  // namespace

Vector balancing_scales(const SparseMatrix& A) {
  constexpr int most_sweeps = 20;
  constexpr int most_doublings = 24;  // a reducible matrix has no balance, and its scales would drift away
  const SparseMatrix transposed = A.transpose();
  Vector d = Vector::Ones(A.rows());
  Vector inverse = d;
  bool changed = true;
  for (int sweep = 0; changed && sweep < most_sweeps; ++sweep) {
    changed = false;
    for (Index i = 0; i < A.rows(); ++i) {
      const double column = off_diagonal_sum(A, i, inverse) * d[i];
      const double row = off_diagonal_sum(transposed, i, d) * inverse[i];
      if (column == 0 || row == 0) continue;
      const int shift = static_cast<int>(std::lround(std::log2(row / column) / 2));
      const int exponent = std::clamp(std::ilogb(d[i]) + shift, -most_doublings, most_doublings);
      if (exponent == std::ilogb(d[i])) continue;
      d[i] = std::ldexp(1.0, exponent);
      inverse[i] = std::ldexp(1.0, -exponent);
      changed = true;
    }
  }
  return d;
}

}  // namespace seiche
