// Operators of any backend as matrices in physical coordinates.
#pragma once

#include <seiche/core/system.hpp>

#include <Eigen/Dense>

namespace seiche::test {

using Matrix = Eigen::MatrixXd;

// The matrix of a linear map given in the coordinates of the backend.
template <class Map>
Matrix matrix_of(const System& system, const Map& map) {
  const Index n = system.space->physical_size();
  Matrix a(n, n);
  Vector z(system.space->size());
  Vector image(system.space->size());
  Vector column(n);
  for (Index j = 0; j < n; ++j) {
    system.space->from_physical(Vector::Unit(n, j), z);
    map(z, image);
    system.space->to_physical(image, column);
    a.col(j) = column;
  }
  return a;
}

// SM of a problem, by stencils or matrices.
inline Matrix SM_of(const Problem& p) {
  return p.matrices ? Matrix(p.matrices->S * p.matrices->M) : Matrix(p.S.matrix(p.grid) * p.M.matrix(p.grid));
}

// e^A by Taylor's series in 80-bit arithmetic after scaling: an independent and slow oracle.
inline Matrix exponential_by_extended_series(const Matrix& A) {
  using Long = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const int squarings = 12;
  const Long a = A.cast<long double>() / (1 << squarings);
  Long term = Long::Identity(A.rows(), A.cols());
  Long sum = term;
  for (int k = 1; k < 40; ++k) {
    term = (term * a / k).eval();
    sum += term;
  }
  for (int i = 0; i < squarings; ++i) sum = (sum * sum).eval();
  return sum.cast<double>();
}

}  // namespace seiche::test
