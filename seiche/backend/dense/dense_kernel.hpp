// The kernel of a full matrix.
#pragma once

#include <seiche/core/vector.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace seiche {

// Orthonormal columns. Singular vectors by the eigenvectors of SᴴS, each tried on S itself: the smallest eigenvalues
// are round-off. In units in which the largest entries of columns and rows are 1: fields have units of their own, and γ
// beside 1 may be 10³⁰ in others.
template <class Matrix>
Matrix dense_kernel(const Matrix& S) {
  const auto unit = [](double largest) { return largest > 0 ? 1 / largest : 1.0; };
  Eigen::VectorXd columns = S.cwiseAbs().colwise().maxCoeff().transpose().unaryExpr(unit);
  Matrix scaled = S * columns.asDiagonal();
  const Eigen::VectorXd rows = scaled.cwiseAbs().rowwise().maxCoeff().unaryExpr(unit);
  scaled = (rows.asDiagonal() * scaled).eval();
  const Eigen::SelfAdjointEigenSolver<Matrix> squares(scaled.adjoint() * scaled);  // ascending
  Index count = 0;
  while (count < S.cols() && (scaled * squares.eigenvectors().col(count)).norm() <= 1e-12 * scaled.norm()) ++count;
  if (count == 0) return Matrix(S.cols(), 0);
  if (columns.minCoeff() == columns.maxCoeff()) return squares.eigenvectors().leftCols(count);
  columns /= columns.maxCoeff();
  const Matrix kernel = columns.asDiagonal() * squares.eigenvectors().leftCols(count);
  return Eigen::HouseholderQR<Matrix>(kernel).householderQ() * Matrix::Identity(S.cols(), count);
}

}  // namespace seiche
