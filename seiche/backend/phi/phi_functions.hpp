// φ-functions of a matrix, real or complex: the whole system (dense) or one small block per mode.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/numerics/congruence.hpp>
#include <seiche/core/phi.hpp>

#include <Eigen/Core>

#include <vector>

namespace seiche {

// What e^{sA} takes from ½|y|² over 0 ≤ s ≤ 1, y the first `rank` components: Iᵣ − EᴴIᵣE = W with W the integral of
// e^{sA}ᴴPe^{sA}.
template <class Matrix>
struct FlowLoss {
  Matrix rate;  // P = −(IᵣA + AᴴIᵣ); empty: E is not to be corrected
  Index rank = 0;
};

// phi[k] ← φ_k(A) for k = 0 … order. With a loss, the length of what φ₀ turns is that of the equation, not of the
// doublings that make it.
template <class Matrix>
void phi_functions(const Matrix& A, Index order, std::vector<Matrix>& phi, const FlowLoss<Matrix>& loss = {});

// S, M and D₀ of a system or of one mode.
template <class Matrix>
struct LinearBlocks {
  Matrix S, M, D0;
  Matrix L() const { return S * M - D0; }
};

// The matrices of one row: blocks[0] of z, then one for each force, with S folded into those of gradients. Where hL is
// large, φ-functions are taken in coordinates of energy, if there are any.
template <class Matrix>
class PhiRowBlocks {
 public:
  PhiRowBlocks(const PhiRows& rows, const LinearBlocks<Matrix>& blocks, double h);

  const std::vector<Matrix>& of(const PhiRow& row);

 private:
  void use_energy(const LinearBlocks<Matrix>& blocks);
  void find_casimirs(const Matrix& D0);
  void return_to_state(double length);

  const PhiRows& rows_;
  const Matrix& S_;
  Matrix L_;
  double h_;
  Matrix T_, inverse_, rate_;  // of coordinates of energy; empty: none
  Index rank_ = 0;
  Matrix casimirs_;
  double decay_ = 0;  // of them
  std::vector<Matrix> phi_, blocks_;
};

// Q of PhiForms: sym(MD) − M sym(S) M.
template <class Matrix>
Matrix dissipation_matrix(const Matrix& S, const Matrix& M, const Matrix& D) {
  const Matrix MD = M * D;
  return 0.5 * (MD + MD.adjoint()) - 0.5 * congruence<Matrix>(S + S.adjoint(), M);
}

// ∫₀ʰ Q(x) dt along ẋ = Lx + n as a form of z = x(0) above n, by the energy at both ends:
//   ½zᴴMz − ½x(h)ᴴMx(h) + Re nᴴM∫x,   x(h) = φ₀z + hφ₁n,   ∫₀ʰx dt = hφ₁z + h²φ₂n,   φ_k of hL
template <class Matrix>
Matrix flow_dissipation(const LinearBlocks<Matrix>& blocks, double h);

}  // namespace seiche
