#include <seiche/core/base/error.hpp>
#include <seiche/core/numerics/eigenpairs.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

template <class Solver>
void take(const Solver& solver, EigenPairs& pairs) {
  if (solver.info() != Eigen::Success)
    throw Error("the eigenvalues of a matrix with {} rows were not found", solver.eigenvalues().size());
  pairs.values = solver.eigenvalues();
  pairs.vectors = solver.eigenvectors();
}

Vector uncertainties(const EigenPairs& pairs, const Eigen::MatrixXcd& A, const Eigen::MatrixXd& noise) {
  // The eigenvalues a ± √(bc) of [a, b; c, a] move by √(|b| δc + |c| δb) where b or c vanishes.
  double widest = noise.diagonal().sum();
  double squares = 0;
  for (Index p = 0; p < A.rows(); ++p)
    for (Index q = 0; q < A.cols(); ++q)
      if (p != q) squares += noise(p, q) * std::abs(A(q, p));
  widest += std::sqrt(squares);
  if (!pairs.has_basis()) return Vector::Constant(A.rows(), widest);
  const Eigen::MatrixXd felt = pairs.dual.cwiseAbs() * noise;
  return felt.cwiseProduct(pairs.vectors.cwiseAbs().transpose()).rowwise().sum().cwiseMin(widest);
}

}  // namespace

EigenPairs eigenpairs(const Eigen::MatrixXcd& A, const Eigen::MatrixXd& noise) {
  EigenPairs pairs;
  if (A.imag().isZero(0)) {
    take(Eigen::EigenSolver<Eigen::MatrixXd>(A.real()), pairs);
  } else {
    take(Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(A), pairs);
  }
  pairs.vectors.colwise().normalize();
  pairs.dual = pairs.vectors.inverse();
  pairs.uncertainty = uncertainties(pairs, A, noise);
  return pairs;
}

std::vector<Index> partners(const EigenPairs& a, const EigenPairs& b, const Eigen::VectorXcd& expected) {
  constexpr double near = 1e-6;  // closer values than that do not count for more: then the vectors decide
  const Index n = a.values.size();
  const Eigen::MatrixXd share = a.has_basis() ? Eigen::MatrixXd((a.dual * b.vectors).cwiseAbs())
                                              : Eigen::MatrixXd::Ones(n, n);  // of vector i of a in vector j of b
  struct Candidate {
    double score;
    Index i, j;
  };
  std::vector<Candidate> candidates;
  candidates.reserve(static_cast<std::size_t>(n * n));
  for (Index j = 0; j < n; ++j) {
    const double largest = share.col(j).maxCoeff();
    for (Index i = 0; i < n; ++i)
      candidates.push_back({share(i, j) / largest / (near + std::abs(b.values[j] - expected[i])), i, j});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& x, const Candidate& y) { return x.score > y.score; });
  const auto none = Index{-1};
  std::vector<Index> partner(static_cast<std::size_t>(n), none);
  std::vector<bool> taken(partner.size());
  for (const auto& [score, i, j] : candidates) {
    const auto of_a = static_cast<std::size_t>(i);
    const auto of_b = static_cast<std::size_t>(j);
    if (partner[of_a] != none || taken[of_b]) continue;
    partner[of_a] = j;
    taken[of_b] = true;
  }
  return partner;
}

}  // namespace seiche
