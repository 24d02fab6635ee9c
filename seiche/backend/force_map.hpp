// The map F of a linear substep z⁺ = Ez + Ff, as matrices: the whole system (dense) or one small block per mode.
#pragma once

#include <seiche/core/propagator.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace seiche {

// F for the step, Q for the predictor ẑ = z + Q(Mz + ∇V(z)).
template <class Matrix>
struct ForceMaps {
  Matrix F;
  Matrix Q;
};

namespace force_map_detail {

template <class Matrix>
double norm_1(const Matrix& a) {
  return a.cwiseAbs().colwise().sum().maxCoeff();
}

// h φ₁(hSM) S = h Σ_k (hSM)ᵏ S / (k+1)! where ‖hSM‖ is at most about ½.
template <class Matrix>
Matrix taylor(const Matrix& S, const Matrix& M, double h) {
  const Matrix A = h * (S * M);
  Matrix term = h * S;
  Matrix F = term;
  for (int k = 1; k <= 24; ++k) {
    term = (A * term / (k + 1)).eval();
    F += term;
  }
  return F;
}

// From h to 2h: E(2h) = E(h)² with E = I + FM. The contract F + Fᵀ + FᵀMF = 0 passes on.
template <class Matrix>
Matrix doubled(const Matrix& F, const Matrix& M) {
  return (2 * F + F * (M * F)).eval();
}

// One Newton–Schulz step towards EᵀME = M: squares the defect R that the doublings left, E ← E(I − ½RM).
template <class Matrix>
void restore_isometry(Matrix& F, const Matrix& M) {
  const Matrix R = F + F.adjoint() + F.adjoint() * (M * F);
  F -= (0.5 * (R + F * (M * R))).eval();
}

}  // namespace force_map_detail

// h φ₁(hSM) S by scaling and doubling; SM may be singular. F is built first and E = I + FM follows from it, so that
// no inverse of SM is ever needed and the two stay consistent.
template <class Matrix>
Matrix exponential_force(const Matrix& S, const Matrix& M, double h) {
  using namespace force_map_detail;
  const Matrix A = h * (S * M);
  const Matrix A2 = A * A;
  // ‖Aᵏ‖^{1/k} instead of ‖A‖: wave systems have entries 1 and 1/Δx² but frequencies 1/Δx.
  const double size = std::max(std::sqrt(norm_1(A2)), std::cbrt(norm_1<Matrix>(A2 * A)));
  const int doublings = size > 0.5 ? static_cast<int>(std::ceil(std::log2(size / 0.5))) : 0;
  Matrix F = taylor<Matrix>(S, M, std::ldexp(h, -doublings));
  for (int i = 0; i < doublings; ++i) F = doubled(F, M);
  const bool skew = (S + S.adjoint()).cwiseAbs().maxCoeff() == 0;
  if (skew && doublings > 0) restore_isometry(F, M);
  return F;
}

// h (I − A/2)⁻¹ S
template <class Matrix>
Matrix cayley_force(const Matrix& S, const Matrix& M, double h) {
  const Matrix A = h * (S * M);
  const Matrix I = Matrix::Identity(S.rows(), S.cols());
  return (I - 0.5 * A).partialPivLu().solve(h * S);
}

template <class Matrix>
ForceMaps<Matrix> force_maps(PropagatorKind kind, const Matrix& S, const Matrix& M, double h) {
  if (kind == PropagatorKind::cayley) {
    Matrix F = cayley_force(S, M, h);
    Matrix Q = 0.5 * F;
    return {std::move(F), std::move(Q)};
  }
  return {exponential_force(S, M, h), exponential_force(S, M, h / 2)};
}

// e^{−hD} = I + F D with F = hφ₁(−hD)(−I).
template <class Matrix>
Matrix damping_exponential(const Matrix& D, double h) {
  const Matrix I = Matrix::Identity(D.rows(), D.cols());
  return I + exponential_force<Matrix>(-I, D, h) * D;
}

}  // namespace seiche
