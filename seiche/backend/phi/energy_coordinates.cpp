#include <seiche/backend/phi/energy_coordinates.hpp>
#include <seiche/core/numerics/congruence.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace seiche {
namespace {

// The kernel of M by orthonormal columns, and all others orthogonal to it: else a motion along the kernel would seem to
// be part of every other. Gram–Schmidt, since it leaves zeros where they are.
template <class Matrix>
void make_kernel_orthonormal(EnergyCoordinates<Matrix>& c) {
  for (Index k = c.rank; k < c.T.cols(); ++k) {
    auto column = c.T.col(k);
    for (int pass = 0; pass < 2; ++pass)
      for (Index l = c.rank; l < k; ++l) column -= c.T.col(l) * c.T.col(l).dot(column);
    column /= column.norm();
    for (Index i = 0; i < c.rank; ++i) c.T.col(i) -= column * column.dot(c.T.col(i));
    c.inverse.row(k) = column.adjoint();
  }
}

}  // namespace

template <class Matrix>
Matrix EnergyCoordinates<Matrix>::structure(const Matrix& S) const {
  const Matrix skew = congruence<Matrix>((S - S.adjoint()) / 2, inverse.adjoint());
  return (skew - skew.adjoint()) / 2 - loss(S) / 2;
}

template <class Matrix>
Matrix EnergyCoordinates<Matrix>::loss(const Matrix& S) const {
  const Matrix rate = congruence<Matrix>(-(S + S.adjoint()), inverse.adjoint());
  return (rate + rate.adjoint()) / 2;
}

template <class Matrix>
Matrix EnergyCoordinates<Matrix>::metric() const {
  Matrix M = Matrix::Zero(T.rows(), T.cols());
  M.topLeftCorner(rank, rank).setIdentity();
  return M;
}

template <class Matrix>
void EnergyCoordinates<Matrix>::scale_kernel(double unit) {
  T.rightCols(T.cols() - rank) *= unit;
  inverse.bottomRows(T.rows() - rank) /= unit;
}

// By LDLᴴ with the largest pivots first. A pivot that is round-off beside the diagonal entry it is left of counts as
// zero; entries that differ by orders of magnitude and do not meet stay apart.
template <class Matrix>
std::optional<EnergyCoordinates<Matrix>> energy_coordinates(const Matrix& M) {
  const Index n = M.rows();
  if (!M.allFinite()) return std::nullopt;
  const double round_off = 4 * epsilon * static_cast<double>(n);
  Matrix A = M;
  std::vector<Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), Index{0});
  const auto entry_of_M = [&](Index k) {
    const Index i = order[static_cast<std::size_t>(k)];
    return std::abs(M(i, i));
  };
  Index rank = 0;
  for (; rank < n; ++rank) {
    Index best = -1;
    for (Index i = rank; i < n; ++i) {
      const double pivot = std::real(A(i, i));
      if (pivot < -round_off * entry_of_M(i)) return std::nullopt;
      if (pivot > round_off * entry_of_M(i) && (best < 0 || pivot > std::real(A(best, best)))) best = i;
    }
    if (best < 0) break;
    A.row(rank).swap(A.row(best));
    A.col(rank).swap(A.col(best));
    std::swap(order[static_cast<std::size_t>(rank)], order[static_cast<std::size_t>(best)]);
    const Index left = n - rank - 1;
    const double pivot = std::real(A(rank, rank));
    auto column = A.col(rank).tail(left);
    const auto row = (column.adjoint() / pivot).eval();
    A.bottomRightCorner(left, left).noalias() -= column * row;
    column /= pivot;
  }
  Matrix L = Matrix::Identity(n, n);
  L.leftCols(rank).template triangularView<Eigen::StrictlyLower>() = A.leftCols(rank);
  const Matrix L_inverse = L.template triangularView<Eigen::UnitLower>().solve(Matrix::Identity(n, n));
  EnergyCoordinates<Matrix> c{Matrix(n, n), Matrix(n, n), rank};
  for (Index k = 0; k < n; ++k) {
    const double root = k < rank ? std::sqrt(std::real(A(k, k))) : 1.0;
    for (Index i = 0; i < n; ++i) {
      const Index place = order[static_cast<std::size_t>(i)];
      c.T(place, k) = Eigen::numext::conj(L_inverse(k, i)) / root;
      c.inverse(k, place) = root * Eigen::numext::conj(L(i, k));
    }
  }
  make_kernel_orthonormal(c);
  return c;
}

template <class Matrix>
double kernel_unit(const EnergyCoordinates<Matrix>& c, const Matrix& S, double h) {
  const Index kernel = S.rows() - c.rank;
  if (kernel == 0) return 1;
  const Matrix along = c.inverse.bottomRows(kernel);
  const Matrix others = c.inverse.topRows(c.rank);
  const Matrix rows = along * S;
  const double round_off = 8 * epsilon * static_cast<double>(S.rows()) * along.norm() * S.norm();
  if (!(rows.norm() > round_off)) return 1;
  const double coupling = std::abs(h) * (rows * others.adjoint()).norm();
  const double inside = std::sqrt(std::abs(h) * (rows * along.adjoint()).norm());
  const double unit = std::max(coupling, inside);
  return unit > 0 && std::isfinite(unit) ? std::exp2(std::ceil(std::log2(unit))) : 1;
}

template struct EnergyCoordinates<Eigen::MatrixXd>;
template std::optional<EnergyCoordinates<Eigen::MatrixXd>> energy_coordinates(const Eigen::MatrixXd& M);
template double kernel_unit(const EnergyCoordinates<Eigen::MatrixXd>& c, const Eigen::MatrixXd& S, double h);
template struct EnergyCoordinates<Eigen::MatrixXcd>;
template std::optional<EnergyCoordinates<Eigen::MatrixXcd>> energy_coordinates(const Eigen::MatrixXcd& M);
template double kernel_unit(const EnergyCoordinates<Eigen::MatrixXcd>& c, const Eigen::MatrixXcd& S, double h);

}  // namespace seiche
