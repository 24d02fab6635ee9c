#include <seiche/backend/phi/dense_kernel.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace seiche {

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

template Eigen::MatrixXd dense_kernel(const Eigen::MatrixXd& S);
template Eigen::MatrixXcd dense_kernel(const Eigen::MatrixXcd& S);

}  // namespace seiche
