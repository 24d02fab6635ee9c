// Which noise balances a constant dissipation.
#pragma once

#include <seiche/core/base/error.hpp>

#include <Eigen/Dense>

#include <cmath>

namespace seiche {

// With L = SM − D₀ and the dissipation R = −S or R = D₀M⁻¹, the B of a kick z ← z + √T Bξ with independent standard
// normal ξ:
//   flow:  BBᵀ = ∫₀ʰ 2e^{−sRM} R e^{−sMR} ds,  so that e^{−hD₀}z + √T Bξ keeps exp(−zᵀMz/2T);
//   kick:  BBᵀ = hR tanh(hMR)/(hMR),           so that kick, e^{hSM} with the same h, kick does.
enum class Fluctuation { flow, kick };

// (BBᵀ)/(hR) as a function of x = hMR.
inline double fluctuation_function(Fluctuation kind, double x) {
  if (kind == Fluctuation::flow) return std::abs(x) < 1e-300 ? 2.0 : -std::expm1(-2 * x) / x;
  return std::abs(x) < 1e-300 ? 1.0 : std::tanh(x) / x;
}

template <class Matrix>
struct DissipationOperator {
  Fluctuation kind = Fluctuation::kick;
  Matrix R, M;
};

inline constexpr const char* noise_needs_skew_S = "noise beside a damping needs a skew S, and S + Sᵀ ≠ 0";
inline constexpr const char* noise_needs_symmetric_S = "noise without a damping needs S = Sᵀ ⪯ 0, and S ≠ Sᵀ";
inline constexpr const char* noise_needs_diagonal_M =
    "noise needs Dz = R∇H, and M is not diagonal where the damping acts";
inline constexpr const char* noise_needs_symmetric_R = "noise needs Dz = R∇H with R = Rᵀ, and DM⁻¹ is not symmetric";

inline constexpr const char* noise_needs_definite_R = "noise needs a dissipation R ⪰ 0, and R has a negative direction";

// Of one block of S, M and D₀, or of whole matrices; `damped`: D₀ acts somewhere, if not in this block. Throws Error
// where Dz is not R∇H with R = Rᵀ ⪰ 0, or S neither skew beside a damping nor symmetric and ⪯ 0 without.
template <class Matrix>
DissipationOperator<Matrix> dissipation(const Matrix& S, const Matrix& M, const Matrix& D0, bool damped) {
  constexpr double round_off = 1e-12;
  const auto differ = [&](const Matrix& a, const Matrix& b) {
    return (a - b).norm() > round_off * (a.norm() + b.norm());
  };
  DissipationOperator<Matrix> d{.kind = damped ? Fluctuation::flow : Fluctuation::kick, .R = -S, .M = M};
  if (damped) {
    if (differ(S, -S.adjoint())) throw Error(noise_needs_skew_S);
    for (Eigen::Index j = 0; j < D0.cols(); ++j) {
      if (D0.col(j).isZero(0)) {
        d.R.col(j).setZero();
        continue;
      }
      const double mass = std::real(M(j, j));
      const double beside = M.col(j).squaredNorm() - mass * mass;
      if (!(mass > 0) || beside > round_off * mass * mass) throw Error(noise_needs_diagonal_M);
      d.R.col(j) = D0.col(j) / mass;
    }
    if (differ(d.R, d.R.adjoint())) throw Error(noise_needs_symmetric_R);
  } else if (differ(S, S.adjoint())) {
    throw Error(noise_needs_symmetric_S);
  }
  return d;
}

// B = (BBᵀ)^{1/2}; with h = 0 nothing is computed but whether R ⪰ 0.
template <class Matrix>
Matrix fluctuation_root(const DissipationOperator<Matrix>& d, double h) {
  constexpr double round_off = 1e-12;
  const Eigen::SelfAdjointEigenSolver<Matrix> of_R(d.R);
  const Eigen::VectorXd& rates = of_R.eigenvalues();
  if (rates.size() > 0 && rates[0] < -round_off * rates.cwiseAbs().maxCoeff())
    throw Error("noise needs a dissipation R ⪰ 0, and R has the eigenvalue {:.3g}", rates[0]);
  if (h == 0) return Matrix::Zero(d.R.rows(), d.R.cols());
  // What is round-off beside the largest is 0: what has a kernel keeps it.
  const auto roots = [](const Eigen::VectorXd& values) -> Eigen::VectorXd {
    const double least = 1e-13 * values.cwiseAbs().maxCoeff();
    return values.unaryExpr([least](double x) { return x > least ? std::sqrt(x) : 0.0; });
  };
  const Matrix G = of_R.eigenvectors() * roots(rates).asDiagonal();  // GGᵀ = R
  // f(hRM) R = G f(hGᵀMG) Gᵀ, whose middle is symmetric also where M is not ≥ 0.
  const Eigen::SelfAdjointEigenSolver<Matrix> middle(G.adjoint() * d.M * G);
  const Eigen::VectorXd f =
      middle.eigenvalues().unaryExpr([&](double x) { return h * fluctuation_function(d.kind, h * x); });
  const Matrix half = G * middle.eigenvectors() * f.cwiseSqrt().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> covariance(half * half.adjoint());
  return covariance.eigenvectors() * roots(covariance.eigenvalues()).asDiagonal() * covariance.eigenvectors().adjoint();
}

}  // namespace seiche
