// Generalised Korteweg–de Vries equation with linear damping, u_t + εu_xxx + ∂_x(σu^{k+1}) + μu = 0, periodic
// (paper Example 3).
#pragma once

#include <seiche/problem/problems.hpp>

namespace seiche {

struct Gkdv {
  double length = 10.0;
  Index points = 20;
  Discretisation discretisation = Discretisation::fd2;
  bool two_thirds = false;  // as in GridOptions
  int exponent = 2;         // k
  double sigma = 0.001;
  double epsilon = 1.0;
  DampingRate mu = nullptr;  // 1/time; null: undamped
};

// H = −ε/2 zᵀRz − σ/(k+2) Σz^{k+2}, S = ∂_x, D = μI. The damping moves what V depends on, and
// for σ > 0 the exact H may rise.
Problem gkdv(const Gkdv& options = {});

ProblemEntry gkdv_entry();

}  // namespace seiche
