// The kernel of a full matrix.
#pragma once

#include <seiche/core/vector.hpp>

#include <Eigen/Eigenvalues>

namespace seiche {

// Orthonormal columns. Singular vectors by the eigenvectors of SᴴS, each tried on S itself: the smallest eigenvalues are round-off.
template <class Matrix>
Matrix dense_kernel(const Matrix& S) {
  const Eigen::SelfAdjointEigenSolver<Matrix> squares(S.adjoint() * S);  // ascending
  Index count = 0;
  while (count < S.cols() && (S * squares.eigenvectors().col(count)).norm() <= 1e-12 * S.norm()) ++count;
  return squares.eigenvectors().leftCols(count);
}

}  // namespace seiche
