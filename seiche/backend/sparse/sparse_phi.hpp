// φ-functions of the sparse backend: trajectories instead of matrices.
#pragma once

#include <seiche/backend/krylov/krylov_phi.hpp>
#include <seiche/core/grid/sparse_operators.hpp>

#include <memory>

namespace seiche {

// S and M are those of `operators`. `support`: the components that V depends on. The kernel of S is that which
// sparse_kernel finds; where it gives up, without_casimirs returns false, and a projection along z may then move
// Casimirs. `space` outlives it.
std::unique_ptr<PhiEvaluator> sparse_phi(std::shared_ptr<const SparseOperators> operators, const SparseMatrix& D0,
                                         Potential::Support support, const Space& space);

}  // namespace seiche
