// Damped nonlinear Klein–Gordon equation, u_tt + γu_t − κΔu + ω²u + αu³ = 0, in one to three dimensions (paper
// Example 1).
#pragma once

#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/problems.hpp>

namespace seiche {

struct KleinGordon {
  GridOptions grid = {.points = {20}, .length = {2.0}};
  double kappa = 0.04;          // wave speed squared
  double omega_squared = 0.2;   // if negative it is moved into V, so that M ⪰ 0
  double alpha = -1.0;          // < 0 focusing: V is unbounded below
  DampingRate gamma = nullptr;  // 1/time; null: undamped
};

// H = ½vᵀv + ½uᵀ(ω²I − κR)u + α/4 Σu⁴, S = [[0, I], [−I, 0]], D = diag(0, γI); the paper's initial data,
// functions of the first coordinate.
Problem klein_gordon(const KleinGordon& options = {});

ProblemEntry klein_gordon_entry();

}  // namespace seiche
