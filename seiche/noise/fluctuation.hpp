// Which noise balances a constant dissipation.
#pragma once

#include <seiche/core/base/error.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <complex>

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

// Of one block of S, M and D₀, or of whole matrices, dense or sparse; `damped`: D₀ acts somewhere, if not in this
// block. Throws Error where Dz is not R∇H with R = Rᵀ, or S neither skew beside a damping nor symmetric without.
template <class Matrix>
DissipationOperator<Matrix> dissipation(const Matrix& S, const Matrix& M, const Matrix& D0, bool damped) {
  using Scalars = Eigen::Matrix<typename Matrix::Scalar, Eigen::Dynamic, 1>;
  constexpr double round_off = 1e-12;
  const auto differ = [](const Matrix& a, const Matrix& b) {
    return Matrix(a - b).norm() > round_off * (a.norm() + b.norm());
  };
  const Matrix adjoint = S.adjoint();
  if (!damped) {
    if (differ(S, adjoint)) throw Error("noise without a damping needs S = Sᵀ ⪯ 0, and S ≠ Sᵀ");
    return {.kind = Fluctuation::kick, .R = -S, .M = M};
  }
  if (differ(S, -adjoint)) throw Error("noise beside a damping needs a skew S, and S + Sᵀ ≠ 0");
  Scalars inverse_mass = Scalars::Ones(M.cols());
  for (Eigen::Index j = 0; j < D0.cols(); ++j) {
    if (D0.col(j).squaredNorm() == 0) continue;
    const double mass = std::real(M.coeff(j, j));
    if (!(mass > 0) || M.col(j).squaredNorm() > (1 + round_off) * mass * mass)
      throw Error("noise needs Dz = R∇H, and M is not diagonal where the damping acts");
    inverse_mass[j] = 1 / mass;
  }
  const Matrix R = D0 * inverse_mass.asDiagonal();
  if (differ(R, R.adjoint())) throw Error("noise needs Dz = R∇H with R = Rᵀ, and DM⁻¹ is not symmetric");
  return {.kind = Fluctuation::flow, .R = R, .M = M};
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
