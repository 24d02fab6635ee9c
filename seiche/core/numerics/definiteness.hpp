// Tests a sparse symmetric matrix for positive semidefiniteness; returns a direction of negative curvature if it fails.
#pragma once

#include <seiche/core/base/sparse_matrix.hpp>

#include <optional>

namespace seiche {

// What counts as zero beside the size of a matrix: its largest entry, or row sum.
inline constexpr double matrix_round_off = 1e-13;

// x with xᵀAx < 0, of norm one.
struct NegativeDirection {
  double value;   // xᵀAx
  Index largest;  // where |x_i| is largest
};

// Nothing where A ⪰ 0 up to matrix_round_off ‖A‖: the signs of the pivots of LDLᵀ decide (Sylvester), and a direction
// found is checked. A: symmetric. Throws Error where A cannot be factorised.
std::optional<NegativeDirection> negative_direction(const SparseMatrix& A);

// ½(A + Aᵀ)
SparseMatrix symmetric_part(const SparseMatrix& A);

}  // namespace seiche
