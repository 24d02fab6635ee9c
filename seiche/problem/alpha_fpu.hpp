// Damped continuous α-FPU equation, u_tt − βu_xxt − (1 + εu_xᵏ)u_xx + m²u + γu_t = 0, u = 0 at both ends
// (paper Example 2, whose printed equation lacks the factor u_xx).
#pragma once

#include <seiche/problem/problems.hpp>

namespace seiche {

struct AlphaFpu {
  enum class Formulation { conservative, dissipative };  // γ in D (Example 2.1) or in S (Example 2.2)

  double length = 2.0;
  Index points = 20;  // N intervals, N − 1 unknowns per field
  int exponent = 1;   // k
  double epsilon = 0.005;
  double beta = 0.01;           // Kelvin–Voigt damping
  DampingRate gamma = nullptr;  // 1/time; null: none
  double mass = 1.0;
  Formulation formulation = Formulation::conservative;
};

// H = ½vᵀv + ½uᵀ(m²I − R)u + ε/(Δx^{k+2}(k+1)(k+2)) Σ_{j=0}^{N−1} (u_{j+1} − u_j)^{k+2}, u_0 = u_N = 0.
// conservative: S skew, D = diag(0, γI − βR); dissipative: S = [[0, I], [−I, −γI]], D = diag(0, −βR).
// Throws Error for the dissipative formulation with γ(t), since S is constant.
Problem alpha_fpu(const AlphaFpu& options = {});

ProblemEntry alpha_fpu_entry();

}  // namespace seiche
