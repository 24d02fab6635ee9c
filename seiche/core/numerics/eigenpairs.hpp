// Eigenvalues of a general matrix, how far round-off may have moved each, and which of two matrices belong together.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <Eigen/Dense>

#include <vector>

namespace seiche {

struct EigenPairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  // columns, of norm one
  Eigen::MatrixXcd dual;  // its inverse: rows are left eigenvectors; not finite where there is no basis of eigenvectors
  // |δλ_i| for perturbations |δA| ≤ noise entry by entry: Σ |ℓ_p| noise_pq |x_q|, and near a Jordan block, where that
  // diverges, the square root that it then is.
  Vector uncertainty;

  bool has_basis() const { return dual.allFinite(); }
};

// A: square; `noise` ≥ 0 of the same shape. Throws Error where the iteration does not converge. A matrix without
// imaginary parts is treated as real: its eigenvalues come as exact conjugate pairs, side by side.
EigenPairs eigenpairs(const Eigen::MatrixXcd& A, const Eigen::MatrixXd& noise);

// partner[i]: the pair of `b` that belongs to pair i of `a`, each taken once. Its vector has much of vector i, and its
// value is near expected[i]; the product of the two decides, best pairs first. All of one size.
std::vector<Index> partners(const EigenPairs& a, const EigenPairs& b, const Eigen::VectorXcd& expected);

}  // namespace seiche
