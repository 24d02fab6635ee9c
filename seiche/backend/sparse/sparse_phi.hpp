// φ-functions of the sparse backend: trajectories instead of matrices.
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>
#include <seiche/core/phi.hpp>
#include <seiche/core/potential.hpp>

#include <algorithm>
#include <memory>

namespace seiche {

// Krylov substeps of one exponential of hL, for the spectral radius ρ of L: each reaches about as far as its dimension
// lets it.
inline double krylov_substeps(double h_rho) { return std::max(1.0, h_rho / 10); }
inline constexpr double most_krylov_substeps = 1e6;

// S and M are those of `operators`. `support`: the components that V depends on. Rows that lie on one trajectory cost
// one Krylov pass together, to about round-off. The kernel of S is that which sparse_kernel finds; where it gives up,
// without_casimirs returns false, and a projection along z may then move Casimirs. All maps of an evaluator
// work in the same memory, up to 31 vectors: no two of them run at a time.
std::unique_ptr<PhiEvaluator> sparse_phi(std::shared_ptr<const SparseOperators> operators,
                                         std::shared_ptr<const SparseMatrix> D0, Potential::Support support);

}  // namespace seiche
