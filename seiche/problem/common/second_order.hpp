// What second-order equations q̈ = … with sparse coefficients share: z = (q, p), S = [[0, I], [−I, 0]].
#pragma once

#include <seiche/core/problem.hpp>

#include <vector>

namespace seiche {

struct Entry {
  Index row, column;
  double value;
};

// n × n; entries at the same place add up.
SparseMatrix assembled(Index n, const std::vector<Entry>& entries);

// M = diag(stiffness, W), D = diag(0, CW) for z = (q, p), where p = W⁻¹q̇. `dashpots` is C, empty for none. q may be
// several fields of `grid`, as many as p; z₀ = 0.
struct Masses {
  std::vector<std::string> fields = {"u", "v"};
  double inverse_mass = 1.0;   // W
  SparseMatrix dashpots = {};  // C
};
Problem second_order_problem(std::string name, const Grid& grid, const SparseMatrix& stiffness, const Masses& masses);

// So many points without a place: Δx = 1.
Grid points_without_place(Index count);

}  // namespace seiche
