// The map F of a linear substep z⁺ = Ez + Ff, as matrices: the whole system (dense) or one small block per mode.
#pragma once

#include <seiche/core/numerics/congruence.hpp>
#include <seiche/core/propagator.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace seiche {

// F for the step, Q for the predictor ẑ = z + Q(Mz + ∇V(z)).
template <class Matrix>
struct ForceMaps {
  Matrix F;
  Matrix Q;
};

// −(S + Sᴴ), what the flow takes from ½zᴴMz + fᴴz per time: twice wᴴ(…)w/2 with w = Mz + f. Zero where S is skew.
template <class Matrix>
Matrix loss_rate(const Matrix& S) {
  return -(S + S.adjoint());
}

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

// One Newton–Schulz step towards F + Fᴴ + FᴴMF = −W (null: zero): squares the defect where little is lost; where much
// is, −W leaves it room.
template <class Matrix>
void restore_contract(Matrix& F, const Matrix& M, const Matrix* W) {
  Matrix R = F + F.adjoint() + congruence(M, F);
  if (W != nullptr) R += *W;
  const Matrix MR = M * R;
  R += F * MR;
  F -= 0.5 * R;
}

// F ← 2F + FMF: of twice the step, as E(2h) = E(h)² with E = I + FM.
template <class Matrix>
void double_force(Matrix& F, const Matrix& M) {
  const Matrix MF = M * F;
  F = (2 * F + F * MF).eval();
}

// F of a step h, grown by doubling from steps so small that Taylor's series is short. Each doubling also doubles what
// round-off has added to the contract F + Fᴴ + FᴴMF = −W. For skew S the loss W is zero. Otherwise it obeys
// W ← W + BᴴWB, B = I + MF, sums of what is ⪰ 0 and thus known to round-off; so the contract is restored on the way.
template <class Matrix>
class ForceDoubling {
 public:
  // At most so many doublings leave the contract at round-off by themselves, but for one restoration of skew S at the
  // end.
  static constexpr int harmless = 8;

  // `rate`: −(S + Sᴴ).
  ForceDoubling(const Matrix& S, const Matrix& M, const Matrix& rate, double h, int doublings)
      : M_(M), rate_(rate), loses_(!rate.isZero(0)) {
    if (loses_ && doublings > harmless) {
      start_with_loss(S, std::ldexp(h, -doublings));
    } else {
      F_ = taylor<Matrix>(S, M, std::ldexp(h, -doublings));
    }
    for (int i = 1; i <= doublings; ++i) {
      if (loses_ && doublings > harmless) double_loss();
      double_force(F_, M_);
      if (i % harmless == 0 && i < doublings) restore();
    }
    if (doublings > harmless) restore();
    if (doublings > 0 && (!loses_ || doublings > harmless)) restore();
  }

  Matrix force() && { return std::move(F_); }

 private:
  // F + Fᴴ + FᴴMF is the integral of −BᴴPB over the step, with P = −(S + Sᴴ). By Gauss's rule with four nodes, exact to
  // round-off where ‖hSM‖ is about 1/16: eighths of what Taylor's series takes.
  void start_with_loss(const Matrix& S, double h) {
    constexpr int parts = 3;
    constexpr std::array<double, 2> place = {0.33998104358485626, 0.86113631159405258};
    constexpr std::array<double, 2> weight = {0.65214515486254614, 0.34785484513745386};
    const Matrix I = Matrix::Identity(S.rows(), S.cols());
    h = std::ldexp(h, -parts);
    W_ = Matrix::Zero(S.rows(), S.cols());
    for (std::size_t i = 0; i < place.size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        const Matrix B = I + M_ * taylor<Matrix>(S, M_, h * (1 + side * place[i]) / 2);
        W_ += (h * weight[i] / 2) * congruence(rate_, B);
      }
    }
    F_ = taylor<Matrix>(S, M_, h);
    for (int i = 0; i < parts; ++i) {
      double_loss();
      double_force(F_, M_);
    }
  }

  void double_loss() {
    const Matrix MF = M_ * F_;
    const Matrix WB = W_ + W_ * MF;
    W_ += (WB + MF.adjoint() * WB).eval();
  }

  void restore() { restore_contract<Matrix>(F_, M_, loses_ ? &W_ : nullptr); }

  const Matrix &M_, &rate_;
  bool loses_;
  Matrix F_, W_;
};

}  // namespace force_map_detail

// ‖Aᵏ‖^{1/k} instead of ‖A‖: wave systems have entries 1 and 1/Δx² but frequencies 1/Δx.
template <class Matrix>
double scaled_norm(const Matrix& A) {
  const Matrix A2 = A * A;
  return std::max(std::sqrt(force_map_detail::norm_1(A2)),
                  std::cbrt(force_map_detail::norm_1<Matrix>((A2 * A).eval())));
}

// At least the spectral radius of A, and the nearest to it of ‖A‖, ‖A²‖^{1/2} and ‖A³‖^{1/3}.
template <class Matrix>
double spectral_bound(const Matrix& A) {
  const Matrix A2 = A * A;
  return std::min({force_map_detail::norm_1(A), std::sqrt(force_map_detail::norm_1(A2)),
                   std::cbrt(force_map_detail::norm_1<Matrix>((A2 * A).eval()))});
}

// How often a matrix of this size is halved for Taylor's series; not at all where it is not finite.
inline int doublings_for(double size) {
  return size > 0.5 && std::isfinite(size) ? static_cast<int>(std::ceil(std::log2(size / 0.5))) : 0;
}

// h φ₁(hSM) S by scaling and doubling; SM may be singular. F is built first and E = I + FM follows from it, so that
// no inverse of SM is ever needed and the two stay consistent. `rate`: −(S + Sᴴ).
template <class Matrix>
Matrix exponential_force(const Matrix& S, const Matrix& M, const Matrix& rate, double h) {
  const int doublings = doublings_for(scaled_norm<Matrix>(h * (S * M)));
  return force_map_detail::ForceDoubling<Matrix>(S, M, rate, h, doublings).force();
}
template <class Matrix>
Matrix exponential_force(const Matrix& S, const Matrix& M, double h) {
  return exponential_force<Matrix>(S, M, loss_rate(S), h);
}

// h (I − A/2)⁻¹ S
template <class Matrix>
Matrix cayley_force(const Matrix& S, const Matrix& M, double h) {
  const Matrix A = h * (S * M);
  const Matrix I = Matrix::Identity(S.rows(), S.cols());
  return (I - 0.5 * A).partialPivLu().solve(h * S);
}

// Orthonormal columns with leftᴴS = 0 and S right = 0. The same hold for F, and round-off beside fast motion may break
// them.
template <class Matrix>
struct Kernels {
  Matrix left, right;
  void restore(Matrix& F) const {
    F -= (left * (left.adjoint() * F)).eval();
    F -= ((F * right) * right.adjoint()).eval();
  }
};

// The same where hSM is so large that the solution leaves the contract; R = hBᴴ(S + Sᴴ)B with B = I + MF/2 for every h.
template <class Matrix>
Matrix contracting_cayley_force(const Matrix& S, const Matrix& M, const Matrix& rate, const Kernels<Matrix>& kernels,
                                double h) {
  Matrix F = cayley_force(S, M, h);
  kernels.restore(F);
  for (int i = 0; i < 2; ++i) {
    const Matrix B = Matrix::Identity(S.rows(), S.cols()) + M * F / 2;
    const Matrix W = h * congruence(rate, B);
    force_map_detail::restore_contract(F, M, &W);
  }
  return F;
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

// e^{−hD} = I + F D with F = hφ₁(−hD)(−I): no contract, and D need not be symmetric.
template <class Matrix>
Matrix damping_exponential(const Matrix& D, double h) {
  using namespace force_map_detail;
  const Matrix I = Matrix::Identity(D.rows(), D.cols());
  const int doublings = doublings_for(scaled_norm<Matrix>(-h * D));
  Matrix F = taylor<Matrix>(-I, D, std::ldexp(h, -doublings));
  for (int i = 0; i < doublings; ++i) double_force(F, D);
  return I + F * D;
}

}  // namespace seiche
