// Damped Burgers and Korteweg–de Vries equations with quadratic energy, u_t + αuu_x + εu_xxx − νu_xx + γu = 0: a
// Poisson system.
#pragma once

#include <seiche/problem/problems.hpp>

namespace seiche {

struct Burgers {
  double length = 1.0;
  Index points = 128;
  Discretisation discretisation = Discretisation::spectral;
  double alpha = 1.0;           // α, strength of the transport
  double epsilon = 0.0;         // ε, dispersion
  double nu = 0.01;             // ν ≥ 0, viscosity
  DampingRate gamma = nullptr;  // 1/time; null: none
  bool soliton = false;         // initial data: a solitary wave of speed 1 (needs α, ε > 0), or one period of a sine
};

// H = ½Σu², S(u) = −ε∂³ − (α/3)(U∂ + ∂U) with U = diag(u), D = −ν∂² + γI: skew for any skew ∂, and S(u)u = −αuu_x −
// εu_xxx in the limit of fine grids. Throws Error where there is no solitary wave.
Problem burgers(const Burgers& options = {});

ProblemEntry burgers_entry();

}  // namespace seiche
