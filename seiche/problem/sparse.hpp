// Any system ż = S∇H(z) − Dz whose S, M and D stand in files.
#pragma once

#include <seiche/core/damping_rate.hpp>
#include <seiche/problem/problems.hpp>

namespace seiche {

struct SparseSystem {
  Index fields = 2;          // 1 or 2: z is that many vectors of equal size, u alone or (u, v); V depends on u
  SparseOperators matrices;  // S empty: [[0, I], [−I, 0]]; D empty: none
  double cubic = 0.0;        // V = cubic/3 Σu³ + quartic/4 Σu⁴
  double quartic = 0.0;
  DampingRate gamma = nullptr;  // of the last field
};

// z₀ = 0 but for a bump in the middle of u. Throws Error where there are other than one or two fields, M has no row,
// the matrices do not fit together, or they break a hypothesis of the energy law (SparseOperators::validate).
Problem sparse_problem(SparseSystem options);

ProblemEntry sparse_entry();

}  // namespace seiche
