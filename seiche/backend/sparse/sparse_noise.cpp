#include <seiche/backend/sparse/sparse_noise.hpp>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr const char* not_definite = "noise needs a dissipation R ⪰ 0, and R has a negative direction";

// G with GGᵀ = R ⪰ 0. Where R has a kernel a pivot is round-off, of either sign; that direction gets no noise.
SparseMatrix factor(const SparseMatrix& R) {
  constexpr double round_off = 1e-10;
  const Vector diagonal = R.diagonal();
  for_entries(R, [&](Index i, Index, double value) {
    if (value != 0 && !(diagonal[i] > 0)) throw Error(not_definite);
  });
  const Vector shifts = diagonal.unaryExpr([](double r) { return r == 0 ? 1.0 : 1e-5 * round_off * r; });
  const Eigen::SimplicialLDLT<SparseMatrix> ldlt(R + SparseMatrix(shifts.asDiagonal()));  // no pivot is 0
  const Vector pivots = ldlt.vectorD(), of_pivots = ldlt.permutationP() * diagonal;
  if (ldlt.info() != Eigen::Success || (pivots.array() < -round_off * of_pivots.array()).any())
    throw Error(not_definite);
  const Vector roots = (pivots.array() > round_off * of_pivots.array() && of_pivots.array() > 0)
                           .select(pivots.cwiseMax(0.0).cwiseSqrt(), 0.0);
  const SparseMatrix L = ldlt.matrixL();
  return ldlt.permutationPinv() * SparseMatrix(L * roots.asDiagonal());
}

class SparseNoise final : public LinearMap {
 public:
  SparseNoise(const DissipationOperator<SparseMatrix>& d, double h) : kind_(d.kind), h_(h), G_(factor(d.R)), M_(d.M) {}

  void apply(const Vector& in, Vector& out) const override { out.noalias() = G_ * root_of_K(in); }

 private:
  // √h f(K)^{1/2} x, K = hGᵀMG: Lanczos with every vector made orthogonal to all before, until two results agree.
  Vector root_of_K(const Vector& x) const {
    constexpr double enough = 1e-10;
    const double length = x.norm();
    if (length == 0) return x;
    const Index most = x.size();
    Matrix V(x.size(), std::min<Index>(most, 32));
    Vector alpha(most), beta(most), before, y, G_times, M_times;
    V.col(0) = x / length;
    for (Index m = 1;; ++m) {
      G_times = G_ * V.col(m - 1);
      M_times.noalias() = M_ * G_times;
      Vector w = h_ * (G_.transpose() * M_times);  // the product of the three may be full
      alpha[m - 1] = V.col(m - 1).dot(w);
      for (int twice = 0; twice < 2; ++twice) w -= V.leftCols(m) * (V.leftCols(m).transpose() * w);
      beta[m - 1] = w.norm();
      const bool ends = m == most || beta[m - 1] <= 1e-14 * (std::abs(alpha.head(m).cwiseAbs().maxCoeff()) + 1e-300);
      if (ends || m % 4 == 0) {
        y = root_of_T(alpha, beta, m);
        const bool settled = before.size() > 0 &&
                             (y.head(before.size()) - before).squaredNorm() + y.tail(m - before.size()).squaredNorm() <=
                                 square(enough) * y.squaredNorm();
        if (ends || settled) return length * (V.leftCols(m) * y);
        before = y;
      }
      if (m == V.cols()) V.conservativeResize(Eigen::NoChange, std::min(most, 2 * m));
      V.col(m) = w / beta[m - 1];
    }
  }

  // √h f(T)^{1/2} e₁, of the tridiagonal T.
  Vector root_of_T(const Vector& alpha, const Vector& beta, Index m) const {
    Eigen::SelfAdjointEigenSolver<Matrix> T;
    T.computeFromTridiagonal(alpha.head(m), beta.head(m - 1));
    const Vector f =
        T.eigenvalues().unaryExpr([&](double x) { return std::sqrt(h_ * fluctuation_function(kind_, x)); });
    return T.eigenvectors() * f.cwiseProduct(T.eigenvectors().row(0).transpose());
  }

  Fluctuation kind_;
  double h_;
  SparseMatrix G_, M_;
};

}  // namespace

std::unique_ptr<LinearMap> sparse_noise(const SparseMatrix& S, const SparseMatrix& M, const SparseMatrix& D0,
                                        double h) {
  return std::make_unique<SparseNoise>(dissipation(S, M, D0, D0.nonZeros() > 0), h);
}

}  // namespace seiche
