#include <seiche/core/base/error.hpp>
#include <seiche/core/numerics/definiteness.hpp>

#include <Eigen/SparseCholesky>

namespace seiche {
namespace {

double largest_row_sum(const SparseMatrix& A) {
  const SparseMatrix absolute = A.cwiseAbs();
  return A.rows() == 0 ? 0.0 : Vector(absolute * Vector::Ones(A.cols())).maxCoeff();
}

// The direction of a small pivot may rise and fall by turns, and xᵀAx be no more than round-off. Power iteration with
// cI − A ⪰ 0, where c bounds the eigenvalues, turns x towards the most negative of them: xᵀAx falls at every step.
void improve(const SparseMatrix& A, double bound, Vector& x) {
  constexpr int steps = 50;
  for (int k = 0; k < steps; ++k) x = (bound * x - A * x).normalized();
}

}  // namespace

SparseMatrix symmetric_part(const SparseMatrix& A) { return 0.5 * (A + SparseMatrix(A.transpose())); }

std::optional<NegativeDirection> negative_direction(const SparseMatrix& A) {
  const double size = largest_row_sum(A);
  if (size == 0) return std::nullopt;
  const SparseMatrix shifted = A + SparseMatrix(matrix_round_off * size *
                                                identity_matrix(A.rows()));  // a pivot that should be 0 is now positive
  Eigen::SimplicialLDLT<SparseMatrix> ldlt(shifted);
  if (ldlt.info() != Eigen::Success)
    throw Error("whether a matrix of {} unknowns is positive semidefinite was not decided: LDLᵀ met a pivot 0",
                A.rows());
  const Vector pivots = ldlt.vectorD();
  Index k = 0;
  if (pivots.minCoeff(&k) >= 0) return std::nullopt;
  Vector x = Vector::Unit(A.rows(), k);  // x = PᵀL⁻ᵀe_k has xᵀ(A + shift)x = d_k
  ldlt.matrixU().solveInPlace(x);
  x = (ldlt.permutationPinv() * x).eval();
  x.normalize();
  improve(A, size, x);
  const double value = x.dot(A * x);
  if (value >= -matrix_round_off * size) return std::nullopt;
  NegativeDirection direction{value, 0};
  x.cwiseAbs().maxCoeff(&direction.largest);
  return direction;
}

}  // namespace seiche
