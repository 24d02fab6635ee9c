// The β chain of Fermi, Pasta, Ulam and Tsingou with friction: unit masses and springs with a cubic term,
//   ü_j = d_j − d_{j−1} + β(d_j³ − d_{j−1}³) − γu̇_j + ν(ḋ_j − ḋ_{j−1}),  d_j = u_{j+1} − u_j.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/problem/problems.hpp>

namespace seiche {

struct BetaFpu {
  Index points = 32;                        // N bonds: N − 1 masses between fixed ends, N on a ring
  Boundary boundary = Boundary::dirichlet;  // or periodic
  double beta = 8.0;
  double internal_friction = 0.0;  // ν ≥ 0, 1/time
  DampingRate gamma = nullptr;     // 1/time; null: none
  double amplitude = 1.0;          // of the first mode, in which it starts at rest
};

// The chain of chain.hpp with H = Σ ½v² + ½d² + β/4 d⁴ and D = diag(0, γI − νR). The defaults are those of the report
// LA-1940 (1955), whose energy returns to the first mode.
Problem beta_fpu(const BetaFpu& options = {});

ProblemEntry beta_fpu_entry();

}  // namespace seiche
